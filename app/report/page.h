#pragma once
// A report's page of Markdown, part by part.

#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/base/table.h"
#include "app/base/timings.h"
#include "app/report/plot.h"
#include "app/report/report.h"

namespace app::report {

/// Returns the command that makes the report again; of more than two files of a sequence it has the first and the last.
std::string command_of(const ReportOptions& options);

class Page {
 public:
  /// Its longer texts are the parts of assets/reports/NAME.txt, where NAME is that of the report. A part is what stands
  /// between the line "=== PART" and the next such line. Throws engine::ResourceError if the file cannot be read.
  explicit Page(const ReportOptions& options) : options_(options) {}

  /// Adds a heading or a paragraph.
  template <class... Values>
  void text(fmt::format_string<Values...> pattern, Values&&... values) {
    parts_.push_back(fmt::format(pattern, std::forward<Values>(values)...) + "\n");
  }
  /// Returns a part of the page's file without its last newline. holes: fmt::arg() for each of its {names}.
  template <class... Holes>
  std::string text_of(const std::string& part, const Holes&... holes) const {
    return fmt::vformat(part_of_file(part), fmt::make_format_args(holes...));
  }
  /// Adds a part of the page's file. Leaves out an item that is only a hole, and empty.
  template <class... Holes>
  void add(const std::string& part, const Holes&... holes) {
    add_filled(text_of(part, holes...));
  }
  /// Adds the part "introduction". Besides `holes` it has {command}, which makes the report again, and {quick}: the
  /// part of this name if the report is quick.
  template <class... Holes>
  void introduce(const Holes&... holes) {
    add("introduction", holes..., fmt::arg("command", command_of(options_)),
        fmt::arg("quick", options_.quick ? text_of("quick") : ""));
  }
  /// Returns a plot without series. The part has a line each for the caption, the title and the axes x and y; the rest
  /// are its settings.
  template <class... Holes>
  Plot plot_of(const std::string& part, std::string name, const Holes&... holes) const {
    return empty_plot(std::move(name), text_of(part, holes...));
  }
  /// Adds a sentence if the times mean little, because the program had to wait for a processor while they were taken;
  /// write_report() also prints it on standard error. Parts on several threads count as good if they had one core
  /// together.
  void warn_if_busy(const TimedParts& timed);
  /// Adds a table. Its first `text_columns` hold text, the others numbers.
  void table(const Table& table, std::size_t text_columns = 1) { parts_.push_back(table.markdown(text_columns)); }
  /// Adds a plot. A plot without a series is left out.
  void plot(Plot plot);

  const std::vector<Plot>& plots() const { return plots_; }
  /// Returns the sentence of warn_if_busy(), or an empty text.
  const std::string& warning() const { return warning_; }
  /// Returns the text. With plots it shows each plot, which lies beside it as NAME.svg.
  std::string markdown(bool with_plots) const;

 private:
  std::string part_of_file(const std::string& part) const;
  void add_filled(std::string text);
  static Plot empty_plot(std::string name, const std::string& text);

  ReportOptions options_;
  std::vector<std::string> parts_;
  std::vector<Plot> plots_;
  std::string warning_;
};

}  // namespace app::report
