#pragma once
// A report's page of Markdown, part by part.

#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/base/table.h"
#include "app/base/timings.h"
#include "app/report/plot.h"

namespace app::report {

/// Returns a sentence on times that mean little, because the program had to wait for a processor while they were taken;
/// empty where they are good. Parts on several threads count as good if they had one core together.
std::string warn_of_busy_machine(const TimedParts& timed);

class Page {
 public:
  /// report: names assets/reports/`report`.txt, which has the longer texts of the page.
  explicit Page(std::string report) : report_(std::move(report)) {}

  /// Adds a heading or a paragraph.
  template <class... Values>
  void text(fmt::format_string<Values...> pattern, Values&&... values) {
    parts_.push_back(fmt::format(pattern, std::forward<Values>(values)...) + "\n");
  }
  /// Adds a part of the page's file: what stands between its line "=== part" and the next such line. holes: fmt::arg()
  /// for each of its {names}. Leaves out an item that is only a hole, and empty. Throws engine::ResourceError if the
  /// file cannot be read.
  template <class... Holes>
  void add(const std::string& part, const Holes&... holes) {
    fill(part, fmt::make_format_args(holes...));
  }
  /// Adds a paragraph that write_report() also prints on standard error. An empty one is left out.
  void warn(const std::string& text);
  /// Adds a table. Its first `text_columns` hold text, the others numbers.
  void table(const Table& table, std::size_t text_columns = 1) { parts_.push_back(table.markdown(text_columns)); }
  /// Adds a plot. A plot without a series is left out.
  void plot(Plot plot);

  const std::vector<Plot>& plots() const { return plots_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Returns the text. With plots it shows each plot, which lies beside it as NAME.svg.
  std::string markdown(bool with_plots) const;

 private:
  void fill(const std::string& part, fmt::format_args holes);

  std::string report_;
  std::vector<std::string> parts_;  // empty: the next plot
  std::vector<Plot> plots_;
  std::vector<std::string> warnings_;
};

}  // namespace app::report
