#include "app/session/simulation.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include "app/base/background.h"
#include "app/base/text.h"
#include "app/base/usage_error.h"
#include "app/session/window_work.h"

namespace app::session {

using softbody::World;

namespace {

/// In slices the page stands still during a step: 25 ms on a usual machine.
constexpr softbody::WorkBudget work_budget =
    usual_runs == Runs::in_slices ? softbody::WorkBudget{.least = 2.5e6, .per_particle = 0} : softbody::window_budget;

/// Returns what was kept, as it was. Throws if there is too little memory.
ShownWorld bring_back(const decltype(KeptWorld::world)& kept, int threads) {
  if (const auto* played = std::get_if<KeptPlayer>(&kept)) {
    played->player->apply(played->scene);
    return played->player;
  }
  auto world = make_window_world({}, {}, threads);
  world->restore(std::get<softbody::Snapshot>(kept));
  return world;
}

compare::HowSimulated how(const World& world) { return {world.scene(), world.integrator_choice()}; }

World& solver(const ShownWorld& shown) {
  if (shown.index() == 1) throw softbody::SceneError("no body can join or change: the motion is recorded");
  return *std::get<0>(shown);
}

}  // namespace

Simulation::Simulation(files::Opened opened, int thread_count, std::string scene_name, SimulationObserver* observer)
    : threads(thread_count), observer_(observer ? *observer : none_), shown_(show_in_window(opened, threads)) {
  const softbody::Scene& scene = opened.scene;
  loaded = {scene, SceneFile(scene_name.empty() ? scene.key : scene_name)};
  if (simulated()) stability_.restart(*simulated());
  before_last_step_.copy(world());
}

void Simulation::advance(double elapsed) {
  notice.age(elapsed);
  if (!stands_still()) clock.advance(elapsed, world().frame_time(), [this] { return step(); });
}

void Simulation::advance_one(double elapsed, bool allowed) {
  notice.age(elapsed);
  if (allowed) clock.advance_one([this] { return step(); });
}

SimulationClock::Step Simulation::step() {
  before_last_step_.copy(world());
  const bool was_at_rest = all_at_rest();
  const bool stepped = std::visit([this](const auto& shown) { return step(*shown); }, shown_);
  if (!stepped) clock.paused = true;
  if (!stepped || !was_at_rest || !all_at_rest()) ++revision_;
  rest_steps_ = std::exchange(last_revision_, revision_) == revision_ ? rest_steps_ + 1 : 0;
  const softbody::StepReport& report = world().last_step();
  step_ms_ = report.total_ms + observer_.stepped() + (beside_ ? beside_->world().last_step().total_ms : 0);
  history.detect_ms.push(world().frame(), static_cast<float>(report.detect_ms));
  history.solve_ms.push(world().frame(), static_cast<float>(report.solve_ms));
  history.contacts.push(world().frame(), static_cast<float>(world().detection().contacts.size()));
  return {report.seconds, step_ms_};
}

/// Takes a step, which may fail, and monitors its stability. Of two worlds, one that has blown up stays as it is.
bool Simulation::step(World& world) {
  if (!clock.paused && !beside_) stability_.dismiss_blow_up();
  const bool had_blown_up = stability_.blow_up().has_value();
  bool stepped = true;
  if (!beside_ || !had_blown_up) {
    if (stability_.before_step(world)) lead_beside([this](Beside& b) { b.keep(stability_.past().snapshots()); });
    stepped = attempt([&] { world.step(); });
    stability_.after_step(world, pause_on_blow_up);
    if (stability_.blow_up() && !had_blown_up && !beside_) clock.paused = true;
  }
  lead_beside([&world](Beside& b) { b.step(world); });
  return stepped;
}

/// Takes a step, which may fail.
bool Simulation::step(Player& player) {
  const int frame = player.frame();
  const std::size_t bodies = player.bodies().count();
  const bool stepped = attempt([&] { player.step(); });
  const bool is_last = player.frame() + 1 == player.recording()->frame_count();
  if (is_last && !loop) clock.paused = true;
  if (player.frame() < frame) {  // it begins again, and nothing moved from the end to the start
    before_last_step_.copy(player);
    history.forget_from(player.frame());
  }
  if (player.bodies().count() >= bodies) return stepped;
  ++revision_;
  ++world_number_;  // reports name bodies that are gone
  observer_.replaced(false);
  return stepped;
}

bool Simulation::stands_still() const {
  if (clock.paused) return !clock.owes_single_step();
  if (last_revision_ != revision_ || rest_steps_ < TimeSeries::capacity) return false;
  const auto is_past = [this](const softbody::Caption& caption) { return caption.frame <= world().frame(); };
  return all_at_rest() && (!as_scripted_ || std::ranges::all_of(world().scene().captions, is_past));
}

std::string Simulation::caption() const {
  std::string text;
  for (const softbody::Caption& caption : world().scene().captions)
    if (as_scripted_ && caption.frame <= world().frame()) text = caption.text;
  return text;
}

/// Returns false, with a notice, if `action` throws. What a world refuses changes nothing; all else (too little memory
/// for a detector, say) pauses, and may have changed something.
bool Simulation::attempt(const std::function<void()>& action) {
  try {
    action();
    return true;
  } catch (const softbody::SceneError& refusal) {
    notice.set(refusal.what());
    return false;
  } catch (const UsageError& refusal) {
    notice.set(refusal.what());
    return false;
  } catch (const std::length_error& beyond_a_limit) {
    notice.set(beyond_a_limit.what());
  } catch (const std::exception& error) {
    notice.set(std::string(defect_prefix) + error.what());
  }
  clock.paused = true;
  ++revision_;
  return false;
}

/// Does something with the second world, if there is one, which ends if this throws.
void Simulation::lead_beside(const std::function<void(Beside&)>& action) {
  if (!beside_) return;
  try {
    action(*beside_);
  } catch (const std::exception& error) {
    beside_.reset();
    notice.set("the second half has ended: " + failure_text(error));
  }
}

void Simulation::set_beside(const std::optional<compare::HowSimulated>& second) {
  notice.clear();
  attempt([&] {
    if (!second) return beside_.reset();
    const World& first = solver(shown_);
    const compare::Difference difference(how(first), *second);
    if (beside_) return beside_->differ(first, difference);
    edits = Half::first;
    beside_.emplace(make_window_world({}, {}, threads), first, difference);
  });
  ++revision_;
}

/// Returns what is shown, with the scene that it was loaded from, under the name of the change that follows. `leaves`:
/// it changes to another world. Without the hand that may hold a body: after an undo nobody would let go.
KeptWorld Simulation::keep(std::string change, bool leaves) const {
  if (player()) {
    const auto& shown = std::get<std::shared_ptr<Player>>(shown_);
    return {KeptPlayer{shown, shown->scene()}, loaded, std::move(change), leaves};
  }
  KeptWorld now{simulated()->snapshot(), loaded, std::move(change), leaves};
  std::get<softbody::Snapshot>(now.world).grab.reset();
  if (beside_) (now.beside = beside_->keep())->world.grab.reset();
  return now;
}

/// Returns what `change` returns: whether it changed anything. False if it throws.
bool Simulation::intervene(const std::function<bool()>& change) {
  notice.clear();
  const collide::Method& method = world().method();
  const collide::Settings settings = world().collision();
  bool changed = false;
  if (!attempt([&] { changed = change(); }) || !changed) return false;
  ++revision_;
  if (&method != &world().method() || settings != world().collision()) observer_.detection_changed();
  return true;
}

/// `joins`: undo() takes the change together with the one before it.
bool Simulation::carry_out(const std::string& name, bool joins, const std::function<bool()>& change) {
  std::optional<KeptWorld> before;
  if (!joins) before = keep(name);
  if (!intervene(change)) return false;
  lead_beside([this](Beside& b) { b.follow(*simulated()); });
  if (before) kept_.push(std::move(*before));
  if (before_pull_) before_pull_ = keep(before_pull_->change);  // a pull that goes on is undone up to here
  return true;
}

bool Simulation::change_scene(const std::string& name, const std::function<void(softbody::Scene&)>& change) {
  softbody::Scene scene = edited(*this).scene();
  change(scene);
  if (scene == edited(*this).scene()) return true;
  return carry_out(name, kept_.ends_with(name), [&] {
    if (&edited(*this) != &world()) {
      beside_->differ(*simulated(), {how(*simulated()), {scene, beside_->world().integrator_choice()}});
      scene = compare::Difference::shared(scene, world().scene());
    }
    if (scene != world().scene()) std::visit([&](auto& shown) { shown->apply(scene); }, shown_);
    return true;
  });
}

bool Simulation::set_integrator(const softbody::IntegratorChoice& choice) {
  assert(simulated());
  if (choice == simulated(edits)->integrator_choice()) return true;
  const std::string name = "Integrator";
  return carry_out(name, kept_.ends_with(name), [&] {
    if (&edited(*this) == &world())
      solver(shown_).set_integrator(choice);
    else
      beside_->differ(*simulated(), {how(*simulated()), {beside_->world().scene(), choice}});
    return true;
  });
}

bool Simulation::change_bodies(const std::string& name, const std::function<bool(World&)>& change) {
  as_scripted_ = false;
  const std::size_t bodies = world().bodies().count();
  const bool changed = carry_out(name, false, [&] { return change(solver(shown_)); });
  if (world().bodies().count() < bodies) replace(false);  // bodies after a deleted one have other ids
  return changed;
}

void Simulation::grab(const softbody::Grab& grab) {
  as_scripted_ = false;
  KeptWorld before = keep("pull of a body");
  if (intervene([&] { return solver(shown_).grab(grab), true; })) before_pull_ = std::move(before);
}

void Simulation::pull_to(const glm::dvec3& target) {
  std::optional<softbody::Grab> grab = grabbed(*this);
  if (!grab) return;
  if (before_pull_) kept_.push(*std::exchange(before_pull_, std::nullopt));
  grab->target = target;
  solver(shown_).grab(grab);
}

void Simulation::release() {
  if (grabbed(*this)) solver(shown_).grab({});
  before_pull_.reset();
}

/// What was found out about the world before is of no use.
void Simulation::replace(bool new_scene) {
  before_last_step_.copy(world());
  clock.restart();
  before_pull_.reset();
  ++revision_;
  ++world_number_;
  observer_.replaced(new_scene);
}

void Simulation::leave_for(ShownWorld next) {
  std::swap(shown_, next);
  if (const auto* left = std::get_if<std::shared_ptr<Player>>(&next)) {  // undo may keep it for long
    (*left)->forget_detection();
    if (!player() || player()->recording() != (*left)->recording()) (*left)->recording()->release();
  }
  next = {};
  clock.speed = 1;
  step_ms_ = world().last_step().total_ms;
  before_last_step_ = {};  // may hold the memory of many bodies
  as_scripted_ = true;
  history = {};
  notice.clear();
  stability_ = {};
  if (simulated()) stability_.restart(*simulated());
  if (player()) beside_.reset();
  lead_beside([this](Beside& b) { b.restart(*simulated()); });
  replace(true);
}

void Simulation::enter(ShownWorld world, LoadedScene scene, std::string name) {
  kept_.push(keep(std::move(name), true));
  loaded = std::move(scene);
  leave_for(std::move(world));
}

void Simulation::reset() {
  try {
    const softbody::Scene& scene = world().scene();
    ShownWorld anew = player() ? show_in_window({scene, player()->recording()}, threads)
                               : make_window_world(scene, simulated()->integrator_choice(), threads);
    enter(std::move(anew), loaded, "reset");
  } catch (const std::exception& error) {
    notice.set(error.what());
  }
}

void Simulation::go(Way way) {
  if (kept_.empty(way)) return notice.tell(way == Way::back ? "Nothing to undo" : "Nothing to redo");
  KeptWorld there = kept_.next(way);
  KeptWorld here = keep(there.change, there.leaves);
  const auto arrive = [&] {
    kept_.turn(way, std::move(here));
    loaded = std::move(there.loaded);
  };
  if (there.leaves) {
    const bool arrived = attempt([&] {
      ShownWorld next = bring_back(there.world, threads);
      arrive();
      leave_for(std::move(next));
    });
    if (!arrived) return;
  } else {
    // The worlds in between are gone again, so this one is the snapshot's.
    arrive();
    intervene([&] {
      if (const auto* played = std::get_if<KeptPlayer>(&there.world))
        std::get<1>(shown_)->apply(played->scene);
      else
        solver(shown_).restore(std::get<0>(there.world));
      return true;
    });
    after_going_back();
  }
  lead_beside([&](Beside& b) { there.beside ? b.go_to(*there.beside, *simulated()) : b.restart(*simulated()); });
  if (!notice.is_error()) notice.tell((way == Way::back ? "Undone: " : "Redone: ") + there.change);
}

void Simulation::rewind_to(int frame) {
  if (simulated() && stability_.keep_present(*simulated()))
    lead_beside([this](Beside& b) { b.keep(stability_.past().snapshots()); });
  const auto& past = stability_.past();
  if (simulated() && past.snapshots().empty()) return;
  notice.clear();
  attempt([&] {
    if (player()) return std::get<1>(shown_)->show(frame);
    World& world = solver(shown_);
    const softbody::Scene in_use = world.scene();
    const softbody::IntegratorChoice integrator = world.integrator_choice();
    world.restore(past.snapshots()[past.at(frame)]);
    if (integrator != world.integrator_choice()) world.set_integrator(integrator);
    world.apply(in_use);
    lead_beside([&world](Beside& b) { b.rewind(world); });
  });
  clock.paused = true;
  after_going_back();
}

void Simulation::after_going_back() {
  if (simulated()) stability_.went_back(*simulated());
  history.forget_from(world().frame());
  replace(false);
}

void toggle_beside(Simulation& simulation) {
  if (simulation.beside()) return simulation.set_beside({});
  simulation.set_beside(compare::usual_second(simulation.world(), simulation.simulated()->integrator_choice()));
}

std::string stopped(const Simulation& simulation, Half half) {
  if (half == Half::second) return simulation.beside()->stopped();
  const auto& blow_up = simulation.stability().blow_up();
  return blow_up ? blow_up->what : "";
}

ShownWorld show_in_window(const files::Opened& opened, int threads) {
  if (opened.recording) return std::make_shared<Player>(opened.recording, opened.scene, threads);
  return make_window_world(opened.scene, {}, threads);
}

std::unique_ptr<World> make_window_world(const softbody::Scene& scene, const softbody::IntegratorChoice& integrator,
                                         int threads) {
  return std::make_unique<World>(
      scene,
      World::Options{
          .threads = threads, .integrator = integrator, .budget = work_budget, .check_work = require_affordable});
}

}  // namespace app::session
