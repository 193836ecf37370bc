// What all reports are written with: tables, pages and plots.

#include <gtest/gtest.h>

#include "app/report/contact/results.h"
#include "app/report/detection/results.h"
#include "app/report/page.h"
#include "app/report/stability/results.h"

namespace app::test {
namespace THIS_FILE {

Table balls() {
  Table table;
  table.add({{"name", "large, \"red\""}, {"radius", 0.1}, {"count", 1234}, {"mass", std::optional<double>()}});
  table.add({{"name", "small"}, {"count", when(false, 3)}, {"mass", 2.5}});
  return table;
}

TEST(Table, IsWrittenAsCsv) {
  EXPECT_EQ(balls().csv(), "name,radius,count,mass\n\"large, \"\"red\"\"\",0.1,1234,\nsmall,,,2.5\n");
}

TEST(Table, IsWrittenAsMarkdownInTheFormOfTheProjectsPages) {
  EXPECT_EQ(
      balls().markdown(),
      "| name | radius | count | mass |\n|---|--:|--:|--:|\n| large, \"red\" | 0.1 | 1234 | |\n| small | | | 2.5 |\n");
  EXPECT_NE(balls().markdown(2).find("|---|---|--:|"), std::string::npos);
}

TEST(Brief, HasThatManyDigitsAndGroupsThem) {
  EXPECT_EQ(brief(0), "0.00");
  EXPECT_EQ(brief(0.01234), "0.0123");
  EXPECT_EQ(brief(9.996), "10.0");
  EXPECT_EQ(brief(12.34), "12.3");
  EXPECT_EQ(brief(1234.5), "1,235");
  EXPECT_EQ(brief(0.694, 2), "0.69");
  EXPECT_EQ(brief(17.9, 2), "18");
}

report::Plot line() {
  report::Plot plot{
      .name = "line", .caption = "A line.", .title = "Bob's", .x = "x", .y = "y", .settings = "set key off\n"};
  plot.add({"rising", "#112233", "lines", {{1, 2, "a"}, {3, 4.5, "b"}}});
  plot.add({"without points", "#000000", "lines"});
  return plot;
}

TEST(Plot, IsDrawnSeriesBySeries) {
  const std::string text = report::script(line());
  EXPECT_NE(
      text.find("set title 'Bob''s'\nset xlabel 'x'\nset ylabel 'y'\nset key off\n$d0 << EOD\n1 2 a\n3 4.5 b\nEOD\n"
                "plot $d0 with lines linecolor rgb '#112233' title 'rising', $d0 using 1:2:3 with labels "),
      std::string::npos)
      << text;
  EXPECT_EQ(text.find("$d1"), std::string::npos) << "no points, no series";
}

TEST(Plot, PrintsLabelsIfAnyPointHasOne) {
  report::Plot plot = line();
  plot.series[0].points[0].label.clear();
  EXPECT_NE(report::script(plot).find(" with labels "), std::string::npos);
  plot.series[0].points[1].label.clear();
  EXPECT_EQ(report::script(plot).find(" with labels "), std::string::npos);
}

TEST(Page, HasOneEmptyLineBetweenItsParts) {
  report::Page page({});
  page.text("# {}", "Balls");
  page.text("- first\n- second");
  page.plot(line());
  page.plot({.name = "nothing", .caption = "", .title = "", .x = "", .y = "", .settings = ""});
  page.text("The end.");
  EXPECT_EQ(page.plots().size(), 1u);
  EXPECT_EQ(page.markdown(true), "# Balls\n\n- first\n- second\n\n![A line.](<line.svg>)\n\nThe end.\n");
  EXPECT_EQ(page.markdown(false), "# Balls\n\n- first\n- second\n\nThe end.\n");
}

TEST(Page, FillsTheHolesOfIntroductionsAndLeavesOutEmptyItems) {
  const auto check = [](const std::string& name, auto results, report::Page (*page_of)(const decltype(results)&)) {
    results.options.name = name;
    for (const bool quick : {false, true}) {
      results.options.quick = quick;
      const std::string text = page_of(results).markdown(false);
      EXPECT_NE(
          text.find("\n\n`sbcollide report " + name + (quick ? " --quick" : "") + " --out DIR` makes this report."),
          text.npos)
          << text;
      EXPECT_EQ(text.find_first_of("{}"), text.npos) << text;
      EXPECT_EQ(text.find("\n- \n"), text.npos) << text;
      EXPECT_EQ(text.find("\n- This is the quick report") != text.npos, quick) << text;
    }
  };
  check("contact", report::ContactResults{}, report::contact_page);
  check("detection", report::DetectionResults{}, report::detection_page);
  check("stability", report::StabilityResults{}, report::stability_page);
}

TEST(Page, WarnsOfTimesOfABusyMachine) {
  for (const TimedParts& good : {TimedParts{.wall = 10, .processor = 9.1}, {.wall = 10, .processor = 17}, {}}) {
    report::Page page({});
    page.warn_if_busy(good);  // also of two threads, or if nothing was timed
    EXPECT_EQ(page.markdown(true) + page.warning(), "");
  }
  const std::string warning = "Times may be off: the program got only 61 % of a core while they were taken.";
  report::Page page({});
  page.text("# Balls");
  page.warn_if_busy({.wall = 10, .processor = 6.1});
  page.text("The end.");
  EXPECT_EQ(page.markdown(true), "# Balls\n\n" + warning + "\n\nThe end.\n");
  EXPECT_EQ(page.warning(), warning);
}

}  // namespace THIS_FILE
}  // namespace app::test
