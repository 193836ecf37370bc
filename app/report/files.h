#pragma once
// What all reports share: the scenes that they run, the line that shows progress, the files that they leave.

#include <functional>
#include <string>
#include <vector>

#include "app/report/plot.h"
#include "app/report/report.h"
#include "softbody/scene.h"

namespace app {

/// A terminal's last line says what is going on.
void say(const std::string& what, double progress);

/// The one that is asked for, or all. Throws SceneError.
std::vector<softbody::Scene> chosen_scenes(const ReportOptions& options);

/// The command that makes the report again.
std::string command_of(const ReportOptions& options);

struct ReportFiles {
  std::string csv_name, csv, markdown_name;
  std::vector<Plot> plots;
  std::function<std::string(const std::vector<Plot>& drawn)> markdown;  // drawn: those that lie beside it
};

/// Writes all of them into a folder that is there. Without gnuplot the plots are left out, which is said: the figures
/// are worth having without them. A terminal is told where they are.
void write_report(const std::filesystem::path& folder, const ReportFiles& files);

}  // namespace app
