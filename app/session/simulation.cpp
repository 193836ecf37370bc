#include "app/session/simulation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/base/usage_error.h"

namespace app::session {

using softbody::World;

namespace {

/// Where the world has other gravity or materials than those in use, it gets these; so too the solids, if asked for.
void keep_settings(World& world, const softbody::Scene& in_use, bool with_solids) {
  const softbody::Scene& now = world.scene();
  if (now.gravity != in_use.gravity) world.set_gravity(in_use.gravity);
  if (with_solids && list_solids(now) != list_solids(in_use)) world.set_solids(in_use);
  for (std::size_t i = 0; i < std::min(now.materials.size(), in_use.materials.size()); ++i)
    if (!(now.materials[i] == in_use.materials[i])) world.set_material(i, in_use.materials[i]);
}

/// The bodies as they were, with the settings in use; `with_its_solids`: with the solids as they were, too.
void restore(World& world, const softbody::Snapshot& snapshot, bool with_its_solids) {
  const std::string method(world.method().key);
  const softbody::ContactSurface surface = world.scene().contact_surface;
  const collide::Settings settings = world.collision();
  const bool default_cell_size = world.scene().default_cell_size;
  const softbody::IntegratorChoice integrator = world.integrator_choice();
  const softbody::Scene in_use = world.scene();
  world.restore(snapshot);
  if (integrator != world.integrator_choice()) world.set_integrator(integrator);
  if (surface != world.scene().contact_surface) world.set_contact_surface(surface);
  keep_settings(world, in_use, !with_its_solids);
  if (method != world.method().key) world.set_method(method);
  if (settings != world.collision() || default_cell_size != world.scene().default_cell_size)
    world.set_collision(settings, default_cell_size);
}

}  // namespace

Simulation::Simulation(softbody::Scene scene, int threads, std::string scene_name, SimulationObserver* observer)
    : observer_(observer ? *observer : none_), threads_(threads) {
  const std::string name = scene_name.empty() ? scene.key : std::move(scene_name);
  world_ = make_window_world(scene, {}, threads_);
  loaded = {scene, SceneFile(name, scene), list_solids(scene)};
  stability_.restart(*world_);
  before_last_step_.copy(*world_);
}

void Simulation::advance(double elapsed, bool stands_still) {
  let_pass(elapsed);
  if (!stands_still) clock.advance(elapsed, world_->frame_time(), [this] { return step(); });
}

void Simulation::advance_one(double elapsed, bool allowed) {
  let_pass(elapsed);
  if (allowed) clock.advance_one([this] { return step(); });
}

SimulationClock::Step Simulation::step() {
  before_last_step_.copy(*world_);
  const bool was_at_rest = world_->all_at_rest();
  const int frame = world_->frame();
  const std::size_t bodies = world_->bodies().count();
  if (!clock.paused) stability_.dismiss_blow_up();
  const bool had_blown_up = stability_.blow_up().has_value();
  stability_.before_step(*world_);
  const bool stepped = attempt([&] { world_->step(); });
  if (!stepped) clock.paused = true;
  if (world_->grabbed()) observer_.intervened();  // another hand would do otherwise
  stability_.after_step(*world_, pause_on_blow_up);
  if (stability_.blow_up() && !had_blown_up) clock.paused = true;
  if (!stepped || !was_at_rest || !world_->all_at_rest()) ++revision_;
  if (world_->scene().recording) follow_recording(frame, bodies);
  rest_steps_ = std::exchange(last_revision_, revision_) == revision_ ? rest_steps_ + 1 : 0;
  const softbody::StepReport& report = world_->last_step();
  step_ms_ = report.total_ms + observer_.stepped();
  history.detect_ms.push(world_->frame(), static_cast<float>(report.detect_ms));
  history.solve_ms.push(world_->frame(), static_cast<float>(report.solve_ms));
  history.contacts.push(world_->frame(), static_cast<float>(world_->detection().contacts.size()));
  return {report.seconds, step_ms_};
}

/// Takes notice of a step of a recording that was at this frame and had so many bodies.
void Simulation::follow_recording(int frame, std::size_t bodies) {
  const bool is_last = world_->frame() + 1 == world_->scene().recording->frame_count();
  if (is_last && !loop) clock.paused = true;
  if (world_->frame() < frame) {  // it begins again, and nothing moved from the end to the start
    before_last_step_.copy(*world_);
    forget_later_steps();
  }
  if (world_->bodies().count() >= bodies) return;
  ++world_number_;  // reports name bodies that are gone
  observer_.replaced(false);
}

bool Simulation::has_come_to_rest() const {
  if (last_revision_ != revision_ || rest_steps_ < TimeSeries::capacity) return false;
  const auto is_past = [this](const softbody::Caption& caption) { return caption.frame <= world_->frame(); };
  return world_->all_at_rest() && (!as_scripted_ || std::ranges::all_of(world_->scene().captions, is_past));
}

float Simulation::between() const {
  return world_->all_at_rest() ? 1.0f : static_cast<float>(clock.fraction(world_->frame_time()));
}

compare::DrawnMeshes Simulation::drawn(bool whole_steps) const {
  return {*world_, before_last_step_, whole_steps ? 1.0f : between()};
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

bool Simulation::change(const std::function<void(World&)>& change) {
  notice.clear();
  const collide::Method& method = world_->method();
  const collide::Settings settings = world_->collision();
  const bool done = attempt([&] { change(*world_); });
  ++revision_;
  observer_.intervened();
  if (&method != &world_->method() || settings != world_->collision()) observer_.detection_changed();
  return done;
}

bool Simulation::change_bodies(std::string name, const std::function<bool(World&)>& change) {
  leave_script();
  KeptWorld before = present({Change::Of::bodies, std::move(name)});
  bool changed = false;
  const std::size_t bodies = world_->bodies().count();
  this->change([&](World& world) { changed = change(world); });
  if (changed) {
    kept_.push(std::move(before));
    if (before_drag_) before_drag_ = present(before_drag_->change);  // a drag that goes on is undone up to here
  }
  if (world_->bodies().count() < bodies) replace(false);  // bodies after a deleted one have other ids
  return changed;
}

void Simulation::pull_to(const glm::dvec3& target) {
  std::optional<softbody::Grab> grab = world_->grabbed();
  if (!grab) return;
  keep_drag();
  grab->target = target;
  world_->grab(grab);
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
  before_last_step_.copy(*world_);
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
  const auto& left = world_->scene().recording;
  if (left && left != world->scene().recording) left->release();  // undo may keep it for long
  world_ = std::move(world);
  clock.speed = 1;
  step_ms_ = world_->last_step().total_ms;
  before_last_step_ = {};  // may hold the memory of many bodies
  as_scripted_ = true;
  history = {};
  notice.clear();
  stability_.restart(*world_);
  replace(true);
}

void Simulation::enter(std::unique_ptr<World> world, LoadedScene scene, std::string name) {
  kept_.push(present({Change::Of::scene, std::move(name)}));
  loaded = std::move(scene);
  leave_for(std::move(world));
}

void Simulation::reset() {
  try {
    enter(make_window_world(scene_in_use(*this), world_->integrator_choice(), threads_), loaded, "reset");
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
      auto world = make_window_world({}, {}, threads_);
      world->restore(there.snapshot);
      arrive();
      leave_for(std::move(world));
    });
  } else {
    // The worlds in between are gone again, so this one is the snapshot's.
    const bool of_solids = there.change.of == Change::Of::solids;
    if (!of_solids) there.loaded.solids = std::move(loaded.solids);  // those in use stay
    arrive();
    notice.clear();
    attempt([&] { restore(*world_, there.snapshot, of_solids); });
    after_going_back();
  }
  if (!notice.is_error()) notice.tell((way == Way::back ? "Undone: " : "Redone: ") + there.change.name);
}

void Simulation::rewind_to(int frame) {
  stability_.keep_present(*world_);
  const auto& past = stability_.past();
  const bool recorded = world_->scene().recording != nullptr;
  if (!recorded && past.snapshots().empty()) return;
  notice.clear();
  attempt([&] {
    if (recorded)
      world_->show_frame(frame);
    else
      restore(*world_, past.snapshots()[past.at(frame)], false);
  });
  clock.paused = true;
  after_going_back();
}

/// Forgets what was recorded of this frame and of later ones.
void Simulation::forget_later_steps() {
  for (TimeSeries* series : {&history.detect_ms, &history.solve_ms, &history.contacts})
    series->forget_from(world_->frame());
}

void Simulation::after_going_back() {
  stability_.went_back(*world_);
  forget_later_steps();
  replace(false);
}

softbody::Scene scene_in_use(const Simulation& simulation) {
  softbody::Scene scene = simulation.loaded.scene;
  const World& world = simulation.world();
  const softbody::Scene& now = world.scene();
  scene.gravity = now.gravity;
  std::ranges::copy(now.materials, scene.materials.begin());
  put_solids(simulation.loaded.solids, scene);
  scene.method = world.method().key;
  scene.contact_surface = now.contact_surface;
  scene.collision = world.collision();
  scene.default_cell_size = now.default_cell_size;
  return scene;
}

std::unique_ptr<World> make_window_world(const softbody::Scene& scene, const softbody::IntegratorChoice& integrator,
                                         int threads) {
  return std::make_unique<World>(
      scene, World::Options{.threads = threads, .integrator = integrator, .budget = softbody::window_budget});
}

}  // namespace app::session
