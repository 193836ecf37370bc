#include "app/session/session.h"

#include <algorithm>
#include <array>
#include <cassert>
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
      import(simulation, scenes, bodies),
      exporter(simulation, comparison) {
  comparison.restart(world(), simulation.revision());
}

void Session::advance(double elapsed, bool waited) {
  if (exporter.recording()) return advance_one(elapsed);
  import.age(elapsed);
  if (!waited) add_picture(elapsed);
  run_ahead.before_advance();
  simulation.advance(elapsed, stands_still());
  exchange();
}

void Session::let_pass(double elapsed) {
  simulation.notice.age(elapsed);
  import.age(elapsed);
  exchange();
}

bool Session::stands_still() const {
  if (simulation.clock.paused) return !simulation.clock.owes_single_step();
  return simulation.has_long_been_at_rest() && ghost_.at_rest();
}

bool Session::awaits_answer() const {
  return comparison.awaits_report(simulation.revision()) || surfaces.awaits_report(simulation.revision());
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
  comparison.exchange(world(), simulation.revision(), simulation.world_number(), rests);
  surfaces.exchange(world(), simulation.before_last_step().simulated(), simulation.revision(), rests);
  sweep_worker.update();
  // With its first report of another world the comparison has let go of the one before; all others did so earlier.
  if (has_left_world_ && comparison.report().id != 0) {
    return_freed_memory();
    has_left_world_ = false;
  }
}

double Session::stepped() {
  if (simulated()) lead_ghost([this] { ghost_.step(*simulated()); });
  return ghost_.step_ms() + run_ahead.stepped();
}

void Session::intervened() {
  lead_ghost([this] { ghost_.restart(simulated()); });
}

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
  intervened();
}

void Session::choose_ghost(const std::optional<softbody::IntegratorChoice>& choice) {
  assert(simulated());
  simulation.notice.clear();
  lead_ghost([&] { ghost_.choose(*simulated(), choice, simulation.threads()); });
}

/// Carries out an action on the ghost. If it throws, a notice says why.
void Session::lead_ghost(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    simulation.notice.set(error.what());
  }
}

}  // namespace app::session
