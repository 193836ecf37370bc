#include "app/session/session.h"

#include <algorithm>
#include <array>
#include <utility>

#include "app/base/heap.h"

namespace app::session {

Session::Session(files::Opened opened, const std::filesystem::path& scene_folder, int threads, std::string scene_name)
    : simulation(std::move(opened), threads, std::move(scene_name), this),
      run_ahead(simulation),
      scenes(simulation, scene_folder),
      bodies(simulation),
      settings(simulation),
      inspector(simulation),
      inspector_beside(simulation, Half::second),
      import(simulation, scenes, bodies),
      exporter(simulation, comparison) {
  comparison.restart(world(), simulation.revision());
}

void Session::advance(double elapsed, bool waited) {
  if (exporter.recording()) return advance_one(elapsed);
  import.age(elapsed);
  if (!waited) add_picture(elapsed);
  run_ahead.before_advance();
  simulation.advance(elapsed);
  exchange();
}

void Session::let_pass(double elapsed) {
  simulation.notice.age(elapsed);
  import.age(elapsed);
  exchange();
}

bool Session::awaits_answer() const {
  return comparison.awaits_report(simulation.revision()) || surfaces.awaits_report(simulation.revision()) ||
         surfaces_beside.awaits_report(simulation.revision()) || price.awaits_price() || guests.loading();
}

News Session::news() const {
  return {.world = simulation.revision(),
          .comparison = comparison.reports(),
          .surfaces = surfaces.reports() + surfaces_beside.reports(),
          .price = price.price(),
          .imported = import.report().size(),
          .notice = simulation.notice.text(),
          .guests = guests.message(),
          .exported = exporter.message(),
          .finishing = exporter.finishing(),
          .sweeping = sweep().running};
}

void Session::advance_one(double elapsed) {
  add_picture(elapsed);
  run_ahead.before_advance();
  simulation.advance_one(elapsed, exporter.may_step());
  exchange();
}

/// Records that a picture came `seconds` after the one before it.
void Session::add_picture(double seconds) {
  simulation.history.frame_ms.push(world().frame(), static_cast<float>(seconds * 1e3));
}

const char* Session::slowest_part() const {
  constexpr std::size_t pictures = 15;
  const StepHistory& history = simulation.history;
  const float picture = history.frame_ms.median(pictures), detect = history.detect_ms.median(pictures),
              solve = history.solve_ms.median(pictures);
  const auto beside = static_cast<float>(std::max(simulation.step_ms() - world().last_step().total_ms, 0.0));
  const double simulated_by_step = world().last_step().seconds > 0 ? world().last_step().seconds : world().frame_time();
  const auto steps = static_cast<float>(simulation.clock.pace() / (1e3 * simulated_by_step)) * picture;
  using Part = std::pair<float, const char*>;  // ms
  const std::array<Part, 4> parts{{{steps * detect, "detection"},
                                   {steps * solve, simulated() ? "solver" : "reading"},
                                   {steps * beside, "second world"},
                                   {picture - steps * (detect + solve + beside), "drawing"}}};
  return std::ranges::max(parts, {}, &Part::first).second;
}

void Session::exchange() {
  constexpr float late_ms = 25;  // fewer than 40 pictures a second
  // The workers rest longer while pictures come late, and where steps need the cores that they would take.
  const bool late = simulation.history.frame_ms.median(15) > late_ms;
  const int rests = late || simulation.step_ms() > 500 * world().frame_time() ? 10 : 2;
  if (const auto method = guests.update()) {
    comparison.method_changed(*method);
    if (sweep().running)
      sweep_worker.cancel();
    else if (!sweep().scene.empty())
      sweep_worker.start(world(), comparison.shown_methods());
  }
  comparison.exchange(world(), simulation.revision(), simulation.world_number(), rests);
  look_at_surfaces(surfaces, Half::first, rests);
  look_at_surfaces(surfaces_beside, Half::second, rests);
  price.exchange(simulated());
  sweep_worker.update();
  // With its first report of another world the comparison has let go of the one before; all others did so earlier.
  if (has_left_world_ && comparison.report().id != 0) {
    return_freed_memory();
    has_left_world_ = false;
  }
}

/// Gives a half's surfaces to the oracle, and counts what it has seen in them.
void Session::look_at_surfaces(SurfaceMonitor& monitor, Half half, int rests) {
  const std::uint64_t reports = monitor.reports();
  monitor.exchange(simulation.world(half), simulation.before_last_step(half).simulated(), simulation.revision(), rests);
  if (monitor.reports() != reports && monitor.report().failure.empty())
    simulation.count(half, monitor.report().figures);
}

double Session::stepped() { return run_ahead.stepped(); }

void Session::detection_changed() {
  inspector.select_bucket(inspector.selected_bucket());  // the table may have fewer buckets
  comparison.detection_changed(world(), simulation.revision());
}

void Session::replaced(bool new_scene) {
  has_left_world_ |= new_scene;
  run_ahead.stop();
  bodies.select(new_scene ? std::nullopt : bodies.selected());
  if (new_scene) inspector.select_bucket({});
  comparison.restart(world(), simulation.revision());
  surfaces.restart(simulation.revision());
  surfaces_beside.restart(simulation.revision());
}

}  // namespace app::session
