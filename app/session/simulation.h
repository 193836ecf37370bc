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

  SimulationClock clock;
  Notice notice;
  LoadedScene loaded;
  StepHistory history;
  bool pause_on_blow_up = true;
  Half edits = Half::first;  // whose settings are changed, if there are two worlds
  bool loop = true;          // what is played begins again after its last frame, and else pauses there

  /// scene_name: what the scene is found by; empty: its key. `observer`, if any, must outlive this. Throws SceneError.
  Simulation(files::Opened opened, int threads, std::string scene_name = "", SimulationObserver* observer = nullptr);
  Simulation(const Simulation&) = delete;

  /// Returns what is shown: one of these two, of which the other is nullptr.
  const softbody::BodiesInMotion& world() const {
    return std::visit([](const auto& shown) -> const softbody::BodiesInMotion& { return *shown; }, shown_);
  }
  /// The same, of a half; of the first while there is no second.
  const softbody::BodiesInMotion& world(Half half) const {
    return beside_ && half == Half::second ? beside_->world() : world();
  }
  const softbody::World* simulated() const { return shown_.index() == 0 ? std::get<0>(shown_).get() : nullptr; }
  const softbody::World* simulated(Half half) const {
    return beside_ && half == Half::second ? &beside_->world() : simulated();
  }
  const Player* player() const { return shown_.index() == 1 ? std::get<1>(shown_).get() : nullptr; }
  int threads() const { return threads_; }
  /// Returns the second world, if there is one: only beside one that is simulated.
  const Beside* beside() const { return beside_ ? &*beside_ : nullptr; }
  /// Lets a second world go on from the present state, or differ so from now on.
  void set_beside(const compare::HowSimulated& second);
  /// Ends the second world, or begins one with compare::usual_second().
  void toggle_beside();
  /// Returns why a half of two is no longer stepped: the sentence of its blow-up; else empty.
  std::string stopped(Half half) const {
    if (half == Half::second) return beside_->stopped();
    return stability_.blow_up() ? stability_.blow_up()->what : "";
  }
  /// Counts what the oracle saw in a half, if there are two.
  void count(Half half, const collide::oracle::SurfaceFigures& seen) {
    if (beside_) beside_->add(half, seen);
  }
  /// Returns the world whose settings are changed.
  const softbody::BodiesInMotion& edited() const { return world(edits); }

  // Time. The world moves in whole frames.
  /// Takes the steps that are due, now that `elapsed` seconds of real time have passed.
  void advance(double elapsed);
  /// In place of advance() while frames are exported: takes one step if `allowed`, however long it takes.
  void advance_one(double elapsed, bool allowed);
  /// How long (ms) the last step took, the observer's work with it.
  double step_ms() const { return step_ms_; }
  const compare::WorldPositions& before_last_step() const { return before_last_step_; }
  /// How far a picture is on the way from before_last_step() to the present, 0 .. 1: below 1 only in slow motion, which
  /// would jerk otherwise.
  float between() const;
  const compare::WorldPositions& before_last_step(Half half) const {
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
  /// Returns true if bodies move from picture to picture.
  bool moves() const { return !clock.paused && !all_at_rest(); }
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

  /// Return true if there is a world to go to, to the bit: one before a change, a reset or a choice of scene; or one
  /// that was left by undo(), until the next such change.
  bool can_undo() const { return !kept_.empty(Way::back); }
  bool can_redo() const { return !kept_.empty(Way::forward); }
  /// Returns true if undo() takes back a change of this name.
  bool undoes(std::string_view change) const { return can_undo() && kept_.next(Way::back).change == change; }
  /// Go there; the notice says what was undone. They stay where they are, with an error, if there is too little memory.
  void undo() { go(Way::back); }
  void redo() { go(Way::forward); }
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
  void go(Way way);
  void after_going_back();
  bool step(softbody::World& world);
  bool step(Player& player);
  SimulationClock::Step step();

  SimulationObserver none_;
  SimulationObserver& observer_;
  int threads_;
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

/// Returns what shows a scene, or plays frames, in a window. Throws SceneError.
ShownWorld show_in_window(const files::Opened& opened, int threads);
/// Returns a world with the work limits of a window. Throws SceneError.
std::unique_ptr<softbody::World> make_window_world(const softbody::Scene& scene,
                                                   const softbody::IntegratorChoice& integrator, int threads);

}  // namespace app::session
