#pragma once
// What all reports share: the scenes that they run, the line that shows progress, the files that they write.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/page.h"
#include "app/report/report.h"
#include "softbody/scene/scene.h"

namespace app::report {

/// Shows what is going on, and how much of it is done. `progress`: from 0 to 1.
void say(const std::string& what, double progress);

/// Calls `task(i)` for each i below `count`, side by side on the threads of the options, and shows `what(i)` meanwhile.
void run_in_parallel(const ReportOptions& options, std::size_t count,
                     const std::function<std::string(std::size_t)>& what, const std::function<void(std::size_t)>& task);

/// Returns the scene that is asked for, or all. Throws SceneError.
std::vector<softbody::Scene> chosen_scenes(const ReportOptions& options);

/// Returns the number of vertices of all bodies, also of those that appear later.
std::uint64_t vertex_count(const softbody::Scene& scene);

/// Writes the figures, the page and its plots into a folder that exists, and prints the path of each file. Further
/// figures that are not empty go into files of their own. The page's warning goes to standard error. Without gnuplot it
/// leaves out the plots and says so there, too.
void write_report(const ReportOptions& options, const Table& figures, std::string_view page_name, const Page& page,
                  const std::vector<std::pair<std::string, Table>>& more_figures = {});

}  // namespace app::report
