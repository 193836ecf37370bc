#include "app/report/report.h"

#include <algorithm>
#include <array>

#include "app/base/usage_error.h"
#include "app/files/scene_folder.h"
#include "engine/resources.h"

namespace app::report {
namespace {

struct Report {
  std::string_view name;
  void (*make)(const ReportOptions& options);
};

constexpr std::array reports{Report{"detection", report_detection}, Report{"contact", report_contact},
                             Report{"solver", report_solver}, Report{"stability", report_stability}};

const Report& find_report(const std::string& name) {
  const auto found = std::ranges::find(reports, name, &Report::name);
  if (found != reports.end()) return *found;
  std::string names;
  for (const Report& r : reports) names.append(names.empty() ? "" : ", ").append(r.name);
  throw UsageError("report " + name + ": unknown; use one of: " + names);
}

}  // namespace

void report(const ReportOptions& options) {
  const Report& report = find_report(options.name);
  // They throw where there is none: some reports need them only after minutes.
  files::scene_folder();
  engine::find_folder("assets/reports");
  report.make(options);
}

}  // namespace app::report
