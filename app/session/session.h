#pragma once
// The demo without window and drawing: a simulation, what the user does with it, and what is found out about it.

#include "app/session/body_controls.h"
#include "app/session/detection_inspector.h"
#include "app/session/export/exporter.h"
#include "app/session/import.h"
#include "app/session/live/guests.h"
#include "app/session/live/live_comparison.h"
#include "app/session/live/price_monitor.h"
#include "app/session/live/surface_monitor.h"
#include "app/session/live/sweep_worker.h"
#include "app/session/run_ahead.h"
#include "app/session/scene_controls.h"
#include "app/session/setting_controls.h"
#include "app/session/simulation.h"

namespace app::session {

/// What changes without input, and needs a picture of the interface when it does: pictures of equal values show the
/// same, apart from how far something has got. Numbers change with what they stand for.
struct News {
  std::uint64_t world = 0, comparison = 0, surfaces = 0;
  const compare::Price* price = nullptr;
  std::size_t imported = 0;  // messages
  std::string notice, guests, exported;
  bool finishing = false, sweeping = false;  // a recording; a sweep

  bool operator==(const News&) const = default;
};

/// Holds the parts together: tells those who look at the world what happens to it.
class Session : private SimulationObserver {
 public:
  /// scene_folder: where other scenes are found by their keys. scene_name: what the scene is found by, if not by its
  /// key. Throws SceneError.
  Session(files::Opened opened, const std::filesystem::path& scene_folder, int threads, std::string scene_name = "");
  Session(const Session&) = delete;

  Simulation simulation;
  RunAhead run_ahead;
  SceneControls scenes;
  BodyControls bodies;
  SettingControls settings;
  DetectionInspector inspector, inspector_beside;  // of the world, and of the second one beside it
  // Beside the window, see Background: their answers come some frames late.
  LiveComparison comparison;
  SurfaceMonitor surfaces, surfaces_beside;
  PriceMonitor price;
  SweepWorker sweep_worker;
  Guests guests;  // go first, so that those above need not wait for what they run
  Import import;
  Exporter exporter;

  const softbody::BodiesInMotion& world() const { return simulation.world(); }
  /// Returns the inspector of Simulation::edited().
  const DetectionInspector& edited_inspector() const {
    return &edited(simulation) == &world() ? inspector : inspector_beside;
  }
  /// Returns the world if it is simulated; nullptr where recorded frames are played.
  const softbody::World* simulated() const { return simulation.simulated(); }

  /// Takes the steps that are due, now that `elapsed` seconds of real time have passed, and follows with all else.
  /// During a recording it does as advance_one(). `waited`: the picture waited on purpose, so `elapsed` is no measure
  /// of the machine.
  void advance(double elapsed, bool waited = false);
  /// The same with one step, however long it takes; none if the exporter may not step.
  void advance_one(double elapsed);

  /// Lets time pass in which the world stands still and nothing is drawn.
  void let_pass(double elapsed);
  /// Returns true if those who look at the world may have an answer soon, though it stands still.
  bool awaits_answer() const;
  News news() const;

  /// Returns what most of the time from one picture to the next goes into: "detection", "drawing".
  const char* slowest_part() const;

  /// Returns the latest sweep.
  const SweepState& sweep() const { return sweep_worker.state(); }

 private:
  double stepped() override;
  void detection_changed() override;
  void replaced(bool new_scene) override;

  void add_picture(double seconds);
  void exchange();
  void look_at_surfaces(SurfaceMonitor& monitor, Half half, int rests);

  bool has_left_world_ = false;  // whose memory is not yet given back
};

}  // namespace app::session

namespace app {
using session::Session;
}  // namespace app
