#include "app/report/report.h"

#include <algorithm>
#include <array>

#include "app/base/usage_error.h"
#include "app/files/inputs.h"
#include "app/report/contact/results.h"
#include "app/report/detection/results.h"
#include "app/report/solver/results.h"
#include "app/report/stability/results.h"
#include "app/report/theory/results.h"
#include "engine/resources.h"

namespace app::report {
namespace {

struct Report {
  std::string_view name;
  /// Writes NAME.csv, a page and plots into options.out, after it has measured everything.
  void (*make)(const ReportOptions& options);
};

constexpr std::array reports{Report{"detection", report_detection}, Report{"contact", report_contact},
                             Report{"solver", report_solver}, Report{"stability", report_stability},
                             Report{"theory", report_theory}};

}  // namespace

std::string report_names(std::string_view before_last) {
  std::string names;
  for (const Report& r : reports)
    names.append(names.empty() ? "" : &r == &reports.back() ? before_last : ", ").append(r.name);
  return names;
}

void report(const ReportOptions& options) {
  const auto report = std::ranges::find(reports, options.name, &Report::name);
  if (report == reports.end()) throw UsageError("report " + options.name + ": unknown; use one of: " + report_names());
  // They throw where there is none: some reports need them only after minutes.
  files::scene_folder();
  engine::find_folder("assets/reports");
  report->make(options);
}

}  // namespace app::report
