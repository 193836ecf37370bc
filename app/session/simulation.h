#pragma once
// What the demo shows, in time: its clock, what the user changes in it, undo and rewind.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/base/time_series.h"
#include "app/compare/positions.h"
#include "app/session/live/beside.h"
#include "app/session/notice.h"
#include "app/session/player.h"
#include "app/session/simulation_clock.h"
#include "app/session/stability/stability_monitor.h"
#include "app/session/undo_history.h"
#include "softbody/world/world.h"

namespace app::session {

/// Is told what happens to the world of a Simulation.
class SimulationObserver {
 public:
  virtual ~SimulationObserver() = default;
  /// Returns how long (ms) the observer worked beside the step.
  virtual double stepped() { return 0; }
  /// The method or its settings are others.
  virtual void detection_changed() {}
  /// The world is another one, or went back, or its bodies have other ids. `new_scene`: it begins at its start.
  virtual void replaced([[maybe_unused]] bool new_scene) {}
};

/// Frame by frame, against the frame of the world.
struct StepHistory {
  TimeSeries frame_ms;  // real time from picture to picture, without those that waited on purpose
  TimeSeries detect_ms, solve_ms, contacts;

  /// Forgets the steps of this frame and of later ones.
  void forget_from(int frame) {
    for (TimeSeries* series : {&detect_ms, &solve_ms, &contacts}) series->forget_from(frame);
  }
};

/// What a session shows: a world that simulates, or a recording that is played. Who needs a solver takes the World.
using ShownWorld = std::variant<std::unique_ptr<softbody::World>, std::shared_ptr<Player>>;

class Simulation {
 public:
  /// The notice begins with it if no input explains the error.
  static constexpr std::string_view defect_prefix = "not enough memory, or a defect of this program: ";

  const int threads;
  SimulationClock clock;
  Notice notice;
  LoadedScene loaded;
  StepHistory history;
  bool pause_on_blow_up = true;
  Half edits = Half::first;  // whose settings are changed, if there are two worlds
  bool loop = true;          // what is played begins again after its last frame, and else pauses there

  /// scene_name: what the scene is found by; empty: its key. `observer`, if any, must outlive this. Throws SceneError.
  Simulation(files::Opened opened, int thread_count, std::string scene_name = "",
             SimulationObserver* observer = nullptr);
  Simulation(const Simulation&) = delete;

  /// Returns what a half shows; the first one while there is no second. It simulates or plays: of simulated() and
  /// player() one is nullptr.
  const softbody::BodiesInMotion& world(Half half = Half::first) const {
    if (beside_ && half == Half::second) return beside_->world();
    return std::visit([](const auto& shown) -> const softbody::BodiesInMotion& { return *shown; }, shown_);
  }
  const softbody::World* simulated(Half half = Half::first) const {
    if (beside_ && half == Half::second) return &beside_->world();
    return shown_.index() == 0 ? std::get<0>(shown_).get() : nullptr;
  }
  const Player* player() const { return shown_.index() == 1 ? std::get<1>(shown_).get() : nullptr; }
  /// Returns the second world, if there is one: only beside one that is simulated.
  const Beside* beside() const { return beside_ ? &*beside_ : nullptr; }
  /// Lets a second world go on from the present state, or differ so from now on, or ends it (nothing).
  void set_beside(const std::optional<compare::HowSimulated>& second);
  /// Counts what the oracle saw in a half, if there are two.
  void count(Half half, const collide::oracle::SurfaceFigures& seen) {
    if (beside_) beside_->add(half, seen);
  }

  // Time. The world moves in whole frames.
  /// Takes the steps that are due, now that `elapsed` seconds of real time have passed.
  void advance(double elapsed);
  /// In place of advance() while frames are exported: takes one step if `allowed`, however long it takes.
  void advance_one(double elapsed, bool allowed);
  /// How long (ms) the last step took, the observer's work with it.
  double step_ms() const { return step_ms_; }
  const compare::WorldPositions& before_last_step(Half half = Half::first) const {
    return beside_ && half == Half::second ? beside_->before_last_step() : before_last_step_;
  }
  /// The scene's sentence for this moment. Empty if there is none, or the user changed bodies.
  std::string caption() const;
  /// Changes whenever positions or contacts may have changed: not with steps of a world at rest.
  std::uint64_t revision() const { return revision_; }
  /// Returns true if no step moves a body of either half.
  bool all_at_rest() const {
    if (!beside_) return world().all_at_rest();
    return (stability_.blow_up() || world().all_at_rest()) && beside_->at_rest();
  }
  /// Returns true if advance() takes no step: the world is paused, or steps would change nothing but the number of the
  /// frame. All bodies have then been at rest for as long as curves last, and no caption is still to come.
  bool stands_still() const;
  /// Counts the worlds: changes whenever the world is replaced.
  std::uint64_t world_number() const { return world_number_; }

  // Changes by the user. They clear notice(); what fails sets it, and errors that no input explains pause. undo() takes
  // them back under their name: those of a setting that follow each other with the same name as one.
  /// Changes the scene in use by `change`; that of the second world if this is edited(), where all that is not of a
  /// Difference acts on both. Returns false if the scene is refused; the world is then as before.
  bool change_scene(const std::string& name, const std::function<void(softbody::Scene&)>& change);
  /// Sets the integrator of edited(), which must be simulated.
  bool set_integrator(const softbody::IntegratorChoice& choice);
  /// Changes bodies. `change` returns whether it changed anything.
  bool change_bodies(const std::string& name, const std::function<bool(softbody::World&)>& change);
  /// A pull of a body is one change, from grab() to release(), if pull_to() is called at all. Each step counts a held
  /// body as a change.
  void grab(const softbody::Grab& grab);
  void pull_to(const glm::dvec3& target);  // m
  void release();
  /// Goes on with `world`, which was made from `scene`. The one before can be had back by undo(), under this name.
  void enter(ShownWorld world, LoadedScene scene, std::string name);
  /// Restarts with the scene in use, without added bodies. On an error the present world goes on.
  void reset();

  /// Returns the worlds to go to, to the bit: those before a change, a reset or a choice of scene; and those that were
  /// left by going back, until the next such change.
  const UndoHistory& undo_history() const { return kept_; }
  /// Goes to the next world of the history; the notice says what was undone or redone. Stays where it is, with an
  /// error, if there is none or too little memory.
  void go(Way way);
  const StabilityMonitor& stability() const { return stability_; }
  /// Goes to the last snapshot of stability().past() that is not after `frame`, or to this frame if it is played, and
  /// pauses. Settings stay.
  void rewind_to(int frame);

 private:
  bool attempt(const std::function<void()>& action);
  bool intervene(const std::function<bool()>& change);
  void lead_beside(const std::function<void(Beside&)>& action);
  KeptWorld keep(std::string change, bool leaves = false) const;
  bool carry_out(const std::string& name, bool joins, const std::function<bool()>& change);
  void replace(bool new_scene);
  void leave_for(ShownWorld next);
  void after_going_back();
  bool step(softbody::World& world);
  bool step(Player& player);
  SimulationClock::Step step();

  SimulationObserver none_;
  SimulationObserver& observer_;
  ShownWorld shown_;
  std::optional<Beside> beside_;
  UndoHistory kept_;
  std::optional<KeptWorld> before_pull_;  // until something is pulled
  bool as_scripted_ = true;               // no body was touched by the user
  compare::WorldPositions before_last_step_;
  double step_ms_ = 0;
  StabilityMonitor stability_;
  std::uint64_t revision_ = 1, world_number_ = 0;
  std::uint64_t last_revision_ = 0;  // after the last step
  std::size_t rest_steps_ = 0;       // without another revision
};

/// Returns what the hand holds.
inline std::optional<softbody::Grab> grabbed(const Simulation& simulation) {
  return simulation.simulated() ? simulation.simulated()->grabbed() : std::nullopt;
}

// What undo and redo can do, and do.
inline bool can_undo(const Simulation& simulation) { return !simulation.undo_history().empty(Way::back); }
inline bool can_redo(const Simulation& simulation) { return !simulation.undo_history().empty(Way::forward); }
inline void undo(Simulation& simulation) { simulation.go(Way::back); }
inline void redo(Simulation& simulation) { simulation.go(Way::forward); }

/// Returns true if bodies move from picture to picture.
inline bool moves(const Simulation& simulation) { return !simulation.clock.paused && !simulation.all_at_rest(); }
/// Returns how far a picture is on the way from before_last_step() to the present, 0 .. 1: below 1 only in slow motion,
/// which would jerk otherwise.
inline float between(const Simulation& simulation) {
  return moves(simulation) ? static_cast<float>(simulation.clock.fraction(simulation.world().frame_time())) : 1.0f;
}
/// Returns the world whose settings are changed.
inline const softbody::BodiesInMotion& edited(const Simulation& simulation) {
  return simulation.world(simulation.edits);
}
/// Ends the second world, or begins one with compare::usual_second(). A world must be simulated.
void toggle_beside(Simulation& simulation);
/// Returns why a half of two is no longer stepped: the sentence of its blow-up; else empty.
std::string stopped(const Simulation& simulation, Half half);

/// Returns what shows a scene, or plays frames, in a window. Throws SceneError.
ShownWorld show_in_window(const files::Opened& opened, int threads);
/// Returns a world with the work limits of a window. Throws SceneError.
std::unique_ptr<softbody::World> make_window_world(const softbody::Scene& scene,
                                                   const softbody::IntegratorChoice& integrator, int threads);

}  // namespace app::session
