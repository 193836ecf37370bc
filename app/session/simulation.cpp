#include "app/session/simulation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/base/timings.h"
#include "app/base/usage_error.h"

namespace app::session {

using softbody::World;

Simulation::Simulation(softbody::Scene scene, int threads, std::string scene_name, SimulationObserver* observer)
    : observer_(observer ? *observer : none_), threads_(threads) {
  const std::string name = scene_name.empty() ? scene.key : std::move(scene_name);
  world_ = make_world(scene, {});
  loaded = {scene, SceneFile(name, scene), list_solids(scene)};
  stability_.restart(*world_);
  before_last_step_.copy(world_->positions());
}

std::unique_ptr<World> Simulation::make_world(const softbody::Scene& scene,
                                              const softbody::IntegratorChoice& integrator) const {
  return std::make_unique<World>(
      scene, World::Options{.threads = threads_, .integrator = integrator, .max_work = softbody::work_of_a_window});
}

void Simulation::add_picture(double seconds) {
  history_.frame_ms.push(world_->frame(), static_cast<float>(seconds * 1e3));
}

void Simulation::advance(double elapsed, bool stands_still) {
  if (clock.paused) stop_running_ahead();
  let_pass(elapsed);
  if (!stands_still) clock.advance(elapsed, world_->frame_time(), [this] { return step(); });
}

void Simulation::advance_one(double elapsed, bool allowed) {
  if (clock.paused) stop_running_ahead();
  let_pass(elapsed);
  if (allowed) clock.advance_one([this] { return step(); });
}

void Simulation::run_ahead(std::function<bool(const World&)> reached, double max_seconds) {
  ahead_ = {std::move(reached), world_->last_step().time + max_seconds};
  clock.running_ahead = true;
  clock.paused = false;
  check_ahead();
}

void Simulation::stop_running_ahead() {
  if (!std::exchange(ahead_, std::nullopt)) return;
  clock.running_ahead = false;
  clock.paused = true;
}

/// Ends the run in the frame that it looks for, and where this frame will not come.
void Simulation::check_ahead() {
  bool goes_on = false;
  attempt(
      [&] { goes_on = !world_->all_at_rest() && world_->last_step().time < ahead_->end && !ahead_->reached(*world_); });
  if (!goes_on) stop_running_ahead();
}

SimulationClock::Step Simulation::step() {
  before_last_step_.copy(world_->positions());
  const bool was_at_rest = world_->all_at_rest();
  if (!clock.paused) stability_.dismiss_blow_up();
  const bool had_blown_up = stability_.blow_up().has_value();
  stability_.before_step(*world_);
  const bool stepped = attempt([&] { world_->step(); });
  if (world_->grabbed()) intervened();  // a hand brings energy
  stability_.after_step(*world_, pause_on_blow_up);
  if (stability_.blow_up() && !had_blown_up) clock.paused = true;
  if (!stepped || !was_at_rest || !world_->all_at_rest()) ++revision_;
  rest_steps_ = std::exchange(last_revision_, revision_) == revision_ ? rest_steps_ + 1 : 0;
  const softbody::StepReport& report = world_->last_step();
  step_ms_ = report.total_ms + observer_.stepped();
  if (!stepped) stop_running_ahead();
  if (ahead_) step_ms_ += time_ms([this] { check_ahead(); });
  history_.detect_ms.push(world_->frame(), static_cast<float>(report.detect_ms));
  history_.solve_ms.push(world_->frame(), static_cast<float>(report.solve_ms));
  history_.contacts.push(world_->frame(), static_cast<float>(world_->detection().contacts.size()));
  return {report.seconds, step_ms_};
}

bool Simulation::has_come_to_rest() const {
  if (last_revision_ != revision_ || rest_steps_ < TimeSeries::capacity) return false;
  const auto is_past = [this](const softbody::Caption& caption) { return caption.frame <= world_->frame(); };
  return world_->all_at_rest() && (!as_scripted_ || std::ranges::all_of(world_->scene().captions, is_past));
}

float Simulation::between() const {
  return world_->all_at_rest() ? 1.0f : static_cast<float>(clock.fraction(world_->frame_time()));
}

compare::DrawnPositions Simulation::drawn_positions(bool whole_steps) const {
  const compare::Positions& before = before_last_step_;
  return {world_->positions(), before.x, before.y, before.z, whole_steps ? 1.0f : between()};
}

const std::string& Simulation::caption() const {
  static const std::string none;
  const std::string* text = &none;
  if (!as_scripted_) return none;
  for (const softbody::Caption& caption : world_->scene().captions)
    if (caption.frame <= world_->frame()) text = &caption.text;
  return *text;
}

/// Returns false, with a notice, if `action` throws. What a world refuses changes nothing; all else (too little memory
/// for a detector, say) pauses.
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
  return false;
}

void Simulation::intervened() {
  stability_.intervened();
  observer_.intervened();
}

bool Simulation::change(const std::function<void(World&)>& change) {
  notice.clear();
  const collide::Method& method = world_->method();
  const collide::Settings settings = world_->collision();
  const bool done = attempt([&] { change(*world_); });
  ++revision_;
  intervened();
  if (&method != &world_->method() || settings != world_->collision()) observer_.detection_changed();
  return done;
}

bool Simulation::change_bodies(std::string name, const std::function<bool(World&)>& change) {
  leave_script();
  KeptWorld before = present({Change::Of::bodies, std::move(name)});
  bool changed = false;
  const std::size_t bodies = world_->bodies().count();
  this->change([&](World& world) { changed = change(world); });
  if (changed) kept_.push(std::move(before));
  if (world_->bodies().count() < bodies) replace(false);  // bodies after a deleted one have other ids
  return changed;
}

void Simulation::pull_to(const glm::dvec3& target) {
  std::optional<softbody::Grab> grab = world_->grabbed();
  if (!grab) return;
  grab->target = target;
  world_->grab(grab);
  keep_drag();
}

void Simulation::release() {
  world_->grab({});
  end_drag();
}

void Simulation::keep_drag() {
  if (before_drag_) kept_.push(*std::exchange(before_drag_, std::nullopt));
}

/// What was found out about the world before is of no use.
void Simulation::replace(bool new_scene) {
  stop_running_ahead();
  before_last_step_.copy(world_->positions());
  clock.restart();
  end_drag();
  ++revision_;
  ++world_number_;
  observer_.replaced(new_scene);
}

/// Without the hand that may hold a body: after an undo nobody would let go.
KeptWorld Simulation::present(Change change) const {
  softbody::Snapshot now = world_->snapshot();
  now.grab.reset();
  return {std::move(now), loaded, std::move(change)};
}

void Simulation::leave_for(std::unique_ptr<World> world) {
  world_ = std::move(world);
  step_ms_ = world_->last_step().total_ms;
  before_last_step_ = {};  // may hold the memory of many bodies
  as_scripted_ = true;
  history_ = {};
  notice.clear();
  stability_.restart(*world_);
  replace(true);
}

void Simulation::enter(std::unique_ptr<World> world, LoadedScene scene, std::string name) {
  kept_.push(present({Change::Of::scene, std::move(name)}));
  loaded = std::move(scene);
  leave_for(std::move(world));
}

softbody::Scene Simulation::scene_in_use() const {
  softbody::Scene scene = loaded.scene;
  const softbody::Scene& now = world_->scene();
  scene.gravity = now.gravity;
  std::ranges::copy(now.materials, scene.materials.begin());
  put_solids(loaded.solids, scene);
  scene.method = world_->method().key;
  scene.contact_surface = now.contact_surface;
  scene.collision = world_->collision();
  scene.default_cell_size = world_->scene().default_cell_size;
  return scene;
}

void Simulation::reset() {
  try {
    enter(make_world(scene_in_use(), world_->integrator_choice()), loaded, "reset");
  } catch (const std::exception& error) {
    notice.set(error.what());
  }
}

void Simulation::go(Way way) {
  if (kept_.empty(way)) return notice.tell(way == Way::back ? "Nothing to undo" : "Nothing to redo");
  KeptWorld there = kept_.next(way);
  KeptWorld here = present(there.change);
  const auto arrive = [&] {
    kept_.turn(way, std::move(here));
    loaded = std::move(there.loaded);
  };
  if (there.change.of == Change::Of::scene) {
    attempt([&] {
      auto world = make_world({}, {});
      world->restore(there.snapshot);
      arrive();
      leave_for(std::move(world));
    });
  } else {
    // The worlds in between are gone again, so this one is the snapshot's.
    const bool of_solids = there.change.of == Change::Of::solids;
    if (!of_solids) there.loaded.solids = std::move(loaded.solids);  // those in use stay
    arrive();
    restore(there.snapshot, of_solids);
    after_going_back();
  }
  if (!notice.is_error()) notice.tell((way == Way::back ? "Undone: " : "Redone: ") + there.change.name);
}

void Simulation::rewind_to(int frame) {
  stability_.keep_present(*world_);
  const auto& past = stability_.past();
  if (past.snapshots().empty()) return;
  restore(past.snapshots()[past.at(frame)]);
  clock.paused = true;
  after_going_back();
}

/// The bodies as they were, with the settings in use; `with_its_solids`: with the solids as they were, too.
void Simulation::restore(const softbody::Snapshot& snapshot, bool with_its_solids) {
  const std::string method(world_->method().key);
  const softbody::ContactSurface surface = world_->scene().contact_surface;
  const collide::Settings settings = world_->collision();
  const bool default_cell_size = world_->scene().default_cell_size;
  const softbody::IntegratorChoice integrator = world_->integrator_choice();
  const softbody::Scene in_use = world_->scene();
  notice.clear();
  attempt([&] {
    world_->restore(snapshot);
    if (integrator != world_->integrator_choice()) world_->set_integrator(integrator);
    if (surface != world_->scene().contact_surface) world_->set_contact_surface(surface);
    keep_settings(in_use, !with_its_solids);
    if (method != world_->method().key) world_->set_method(method);
    if (settings != world_->collision() || default_cell_size != world_->scene().default_cell_size)
      world_->set_collision(settings, default_cell_size);
  });
}

/// Where the world has other gravity or materials than those in use, it gets these; so too the solids, if asked for.
void Simulation::keep_settings(const softbody::Scene& in_use, bool with_solids) {
  const softbody::Scene& now = world_->scene();
  if (now.gravity != in_use.gravity) world_->set_gravity(in_use.gravity);
  if (with_solids && list_solids(now) != list_solids(in_use)) world_->set_solids(in_use);
  for (std::size_t i = 0; i < std::min(now.materials.size(), in_use.materials.size()); ++i)
    if (!(now.materials[i] == in_use.materials[i])) world_->set_material(i, in_use.materials[i]);
}

void Simulation::after_going_back() {
  stability_.went_back(*world_);
  for (TimeSeries* series : {&history_.detect_ms, &history_.solve_ms, &history_.contacts})
    series->forget_from(world_->frame());
  replace(false);
}

}  // namespace app::session
