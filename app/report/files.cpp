#include "app/report/files.h"

#include <cstdio>
#include <iostream>

#include <fmt/core.h>

#include "app/base/streams.h"
#include "app/files/inputs.h"
#include "app/files/output_file.h"
#include "collide/core/workers.h"

namespace app::report {
namespace {

/// Returns file names and contents; nothing if gnuplot cannot draw them.
std::vector<std::pair<std::string, std::string>> draw_all(const std::vector<Plot>& plots) {
  std::vector<std::pair<std::string, std::string>> pictures;
  try {
    for (const Plot& plot : plots) {
      say("plot " + plot.name, double(pictures.size() / 2) / double(plots.size()));
      pictures.emplace_back(plot.name + ".svg", draw(plot, "svg size 960,720 font 'sans-serif,14'"));
      pictures.emplace_back(plot.name + ".png", draw(plot, "pngcairo size 960,720 font 'sans,11'"));
    }
  } catch (const std::runtime_error& error) {
    clear_progress();
    std::fprintf(stderr, "sbcollide: the plots are left out: %s\n", error.what());
    pictures.clear();
  }
  return pictures;
}

}  // namespace

void say(const std::string& what, double progress) {
  show_progress(fmt::format("{:<50} {:3.0f} %", what, 100 * progress));
}

void run_in_parallel(const ReportOptions& options, std::size_t count,
                     const std::function<std::string(std::size_t)>& what,
                     const std::function<void(std::size_t)>& task) {
  collide::Workers workers(options.threads.value_or(options.cores));
  workers.share(workers.threads(), count, [&](int thread, std::size_t i) {
    if (thread == 0) say(what(i), double(i) / double(count));
    task(i);
  });
}

std::vector<softbody::Scene> chosen_scenes(const ReportOptions& options) {
  const std::filesystem::path folder = files::scene_folder();
  std::vector<softbody::Scene> scenes;
  for (const std::string& name : options.scene ? std::vector{*options.scene} : softbody::scene_keys(folder)) {
    scenes.push_back(softbody::find_scene(name, folder));
    files::protect_input(softbody::scene_path(name, folder));
    files::protect_input(softbody::presets_path(folder));
    files::protect_inputs(scenes.back());
  }
  return scenes;
}

std::uint64_t vertex_count(const softbody::Scene& scene) {
  std::uint64_t vertices = 0;
  for (const softbody::BodySource& body : scene.bodies) vertices += body.mesh.vertex_count();
  return vertices;
}

void write_report(const ReportOptions& options, const Table& figures, std::string_view page_name, const Page& page,
                  const std::vector<std::pair<std::string, Table>>& more_figures) {
  auto files = draw_all(page.plots());
  clear_progress();
  const std::string text = page.markdown(!files.empty());
  files.emplace(files.begin(), options.name + ".csv", figures.csv());
  for (const auto& [name, table] : more_figures)
    if (!table.empty()) files.emplace_back(name, table.csv());
  files.emplace_back(page_name, text);
  for (const auto& [name, bytes] : files) files::require_no_input(options.out / name);
  for (const auto& [name, bytes] : files) files::write_file(options.out / name, bytes);
  for (const auto& [name, bytes] : files) std::cout << (options.out / name).string() << '\n';
  if (!page.warning().empty()) std::fprintf(stderr, "sbcollide: %s\n", page.warning().c_str());
}

}  // namespace app::report
