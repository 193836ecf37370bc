// World: what is changed by hand, between frames, and snapshots to return to.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

#include "softbody/mesh/limits.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/state/rigid_motion.h"
#include "softbody/world/measures.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world_parts.h"

namespace softbody {

void World::Parts::update_plan() {
  plan = make_plan(scene, models.all(), added_bodies);
  solver.set_plan(plan);
}

/// Throws SceneError if `number` more bodies would exceed max_particles.
void World::Parts::check_capacity(const BodyModel& model, std::size_t number) const {
  const std::uint64_t vertices =
      shown().bodies.vertex_count() + std::uint64_t{number} * model.shown().mesh.vertices.size();
  if (vertices <= max_particles) return;
  throw SceneError("scene '" + scene.key + "': there is no room for " + std::to_string(number) +
                   " more bodies: " + std::to_string(vertices) + " vertices (at most " + std::to_string(max_particles) +
                   "); take bodies out first");
}

void World::Parts::bodies_added(std::size_t number) {
  added_bodies.bodies += number;
  update_plan();
  update_positions();
  detect();
}

/// Returns the height at which a body dropped at `position` touches no other body.
double World::Parts::clear_height(const BodyModel& model, const glm::dvec3& position) const {
  double height = position.y;
  const double clear = 1.3 * model.radius + settings.tolerance;
  const collide::Frame now = particles.input();
  for (Index i = 0; i < now.x.size(); ++i)
    if (glm::length(glm::dvec2(now.x[i] - position.x, now.z[i] - position.z)) < clear)
      height = std::max(height, now.y[i] + clear);
  return height;
}

void World::Parts::drop(const Dropper& dropper) {
  // Each drop turns by the golden angle, so that no two fall alike.
  const double distance = dropper.spread * std::sqrt((drops++ % 16 + 0.5) / 16);
  const auto [c, n] = drop_direction;
  drop_direction = {-0.7373688780783197 * c - 0.6754902942615238 * n, 0.6754902942615238 * c - 0.7373688780783197 * n};
  BodySource source = dropper.body;
  source.position += distance * glm::dvec3(c, 0, n);
  source.position.y = clear_height(*models.of(source), source.position);
  spawn(std::move(source));
  update_positions();
}

BodyId World::Parts::spawn(BodySource source) {
  source.appear = frame;
  source.release = frame;
  const BodyId id = add(source, source.position);
  added_bodies.holds = added_bodies.holds || !source.holds.empty();
  added.push_back({id, std::move(source)});
  return id;
}

Dropper World::Parts::dropper() const {
  Dropper dropper = scene.dropper ? *scene.dropper : Dropper{.body = scene.bodies.front()};
  dropper.body.holds.clear();  // they are elsewhere
  return dropper;
}

/// True if a new body would be outside all solids and no vertex of another body in its bounding box.
bool World::Parts::is_clear(const BodyModel& model, const BodySource& source) const {
  const std::vector<glm::dvec3> start = turned(model.start, source.axes);
  const glm::dvec3 position = source.position;
  glm::dvec3 lo = start.front(), hi = lo;
  for (const glm::dvec3& v : start) {
    if (solid_depth(scene, position + v).depth > -model.material[Material::thickness]) return false;
    lo = glm::min(lo, v), hi = glm::max(hi, v);
  }
  const glm::vec3 low(position + lo - double(settings.tolerance)), high(position + hi + double(settings.tolerance));
  const collide::Frame now = particles.input();
  for (Index i = 0; i < now.x.size(); ++i) {
    const glm::vec3 v(now.x[i], now.y[i], now.z[i]);
    if (glm::all(glm::lessThan(low, v)) && glm::all(glm::lessThan(v, high))) return false;
  }
  return true;
}

std::optional<BodyId> World::throw_body(const glm::dvec3& from, const glm::dvec3& velocity) {
  Parts& s = *parts_;
  BodySource source = s.dropper().body;
  const BodyModel& model = *s.models.of(source);
  const double pace = std::min(model.radius, 0.5);  // m
  constexpr int max_paces = 20;
  assert(velocity != glm::dvec3(0.0));
  const glm::dvec3 gravity = s.scene.gravity;
  for (int i = 2; i < max_paces; ++i) {
    const double time = i * pace / glm::length(velocity);
    source.position = from + time * velocity + 0.5 * time * time * gravity;
    source.velocity = velocity + time * gravity;
    if (s.is_clear(model, source)) return add(source);
  }
  return std::nullopt;
}

const std::vector<AddedBody>& World::added() const { return parts_->added; }

std::vector<BodySource> World::body_sources() const {
  const std::vector<AddedBody>& added = this->added();
  const auto first_late = std::ranges::find_if(added, [](const AddedBody& one) { return one.source.appear > 0; });
  std::vector<BodySource> all;
  auto late = first_late;
  for (int i = 0; const BodySource& body : scene().bodies) {
    // A body added between two steps comes before those that the scene brings in the next one.
    for (; late != added.end() && late->source.appear <= body.appear; ++late) all.push_back(late->source);
    all.push_back(body);
    const auto changed = parts_->changed_holds.find(i++);
    if (changed != parts_->changed_holds.end()) all.back().holds = changed->second;
  }
  for (auto one = added.begin(); one != first_late; ++one) all.push_back(one->source);
  for (; late != added.end(); ++late) all.push_back(late->source);
  return all;
}

BodyId World::drop(int count) {
  assert(count >= 1);
  Parts& s = *parts_;
  Dropper dropper = s.dropper();
  s.check_capacity(*s.models.of(dropper.body), std::size_t(count));
  // Many would pile up to a tower: they fall side by side.
  if (count > 1) dropper.spread = std::max(dropper.spread, 4 * s.models.of(dropper.body)->radius);
  for (int i = 0; i < count; ++i) s.drop(dropper);
  s.bodies_added(std::size_t(count));
  return s.particles.bodies.count() - 1;
}

BodyId World::add(const BodySource& source) {
  Parts& s = *parts_;
  BodyModelSet more = s.models;
  s.check_capacity(*more.add(source, s.scene.materials), 1);
  s.check_sizes(more, s.choice);
  s.models = std::move(more);
  s.settings = s.settings_of(s.scene);  // this mesh may be larger than all others
  const BodyId id = s.spawn(source);
  s.bodies_added(1);
  return id;
}

/// Wakes the bodies near this one: they may rest on it, even if the detector reports no contact.
void World::Parts::wake_near(BodyId body) {
  const collide::Frame now = particles.input();
  const collide::Bodies& bodies = particles.bodies;
  const auto box = [&](BodyId b) {
    const collide::VertexRun at = collide::vertices_of(now, b);
    glm::vec3 lo = at[0], hi = lo;
    for (Index i = 0; i < at.size; ++i) lo = glm::min(lo, at[i]), hi = glm::max(hi, at[i]);
    return std::pair(lo, hi);
  };
  const float wake_distance = std::max(settings.tolerance, 0.25f * float(solver.state().model(body).mean_edge));
  const auto [lo, hi] = box(body);
  for (BodyId b = 0; b < bodies.count(); ++b) {
    if (!solver.state().body(b).asleep) continue;
    const auto [low, high] = box(b);
    if (glm::all(glm::lessThan(low, hi + wake_distance)) && glm::all(glm::lessThan(lo, high + wake_distance)))
      solver.state().set_asleep(b, false);
  }
}

void World::remove(BodyId body) {
  Parts& s = *parts_;
  assert(body < s.particles.bodies.count());
  s.wake_near(body);
  s.book_change([&] { s.solver.remove(body); });
  std::erase_if(s.added, [&](const AddedBody& one) { return one.body == body; });
  for (AddedBody& one : s.added) one.body -= one.body > body;
  s.count_vertices();
  s.added_bodies.grabs = s.solver.hand().grab().has_value();
  s.update_plan();
  s.update_positions();
  s.for_each_meshes([](DetectedMeshes& meshes) { meshes.detector->forget(); });
  s.detect();
}

void World::grab(const std::optional<Grab>& grab) {
  Parts& s = *parts_;
  assert(!grab || grab->body < s.particles.bodies.count());
  if (grab) s.solver.state().set_pinned(grab->body, false);
  s.solver.hand().take(grab);
  s.added_bodies.grabs = grab.has_value();
  s.update_plan();
}

const std::optional<Grab>& World::grabbed() const { return parts_->solver.hand().grab(); }

/// Returns what the scene, or the source of an added body, says of its holds, to be changed.
std::vector<Hold>& World::Parts::source_holds(BodyId body) {
  const auto own = std::ranges::find(added, body, &AddedBody::body);
  if (own != added.end()) return own->source.holds;
  const int index = std::as_const(solver).state().body(body).memory.source;
  return changed_holds.try_emplace(index, scene.bodies[std::size_t(index)].holds).first->second;
}

bool World::switch_hold(BodyId body, Index particle) {
  assert(particle < parts_->particles.bodies.size(body));
  const int frame = parts_->frame;
  std::vector<Hold>& told = parts_->source_holds(body);
  std::vector<HeldVertices> holds = state().body(body).memory.holds;  // one for each of them
  const std::vector<glm::dvec3>& at_rest = model(body).mesh.vertices;
  const auto is_near = [&](Index i) {
    return glm::distance(at_rest[i], at_rest[particle]) <= 0.2 * model(body).radius;
  };
  bool lets_go = false;
  for (std::ptrdiff_t i = 0; i < std::ssize(holds); ++i) {
    auto hold = holds.begin() + i;
    auto source = told.begin() + i;
    if (!hold->on || std::ranges::none_of(hold->vertices, is_near)) continue;
    lets_go = true;
    if (hold->from < frame) {  // another one goes on with the others
      ++i;
      hold = holds.insert(hold + 1, *hold), source = told.insert(source + 1, *source);
      (hold - 1)->until = (source - 1)->until = frame;
    }
    std::erase_if(hold->vertices, is_near);
    hold->from = source->from = frame;
    source->where = SolidBox{}, source->vertices = hold->vertices, source->through = hold->through;
    if (hold->vertices.empty()) holds.erase(hold), told.erase(source), --i;
  }
  if (!lets_go) {
    holds.push_back({.vertices = {particle}, .from = frame});
    told.push_back({.vertices = {particle}, .from = frame});
  }
  parts_->hold(body, std::move(holds));
  return !lets_go;
}

std::vector<Index> World::held(BodyId body) const {
  std::vector<Index> all;
  for (const HeldVertices& h : state().body(body).memory.holds)
    if (h.on) all.insert(all.end(), h.vertices.begin(), h.vertices.end());
  return all;
}

void World::copy_holds(const World& other) {
  const auto facts = [](const HeldVertices& h) { return std::tie(h.vertices, h.from, h.until); };
  for (BodyId b = 0; b < parts_->particles.bodies.count(); ++b) {
    const std::vector<HeldVertices>&own = state().body(b).memory.holds, &others = other.state().body(b).memory.holds;
    if (std::ranges::equal(own, others, {}, facts, facts)) continue;
    parts_->source_holds(b) = other.parts_->source_holds(b);
    parts_->hold(b, others);
  }
}

void World::Parts::hold(BodyId body, std::vector<HeldVertices> holds) {
  solver.state().memory(body).holds = std::move(holds);
  solver.state().set_asleep(body, false);
  switch_holds(body);
  added_bodies.holds = true;
  update_plan();
}

double World::Parts::energy() const {
  double sum = 0;
  for (const BodyMeasures& m : measure_bodies(solver.state(), scene.gravity))
    sum += m.conserved(solver.state().ledger.staggering);
  return sum;
}

void World::apply(const Scene& wanted) {
  Parts& s = *parts_;
  Scene next = wanted;
  next.bodies = s.scene.bodies, next.dropper = s.scene.dropper;
  const std::size_t known = s.scene.materials.size();
  for (std::size_t i = next.materials.size(); i < known; ++i) next.materials.push_back(s.scene.materials[i]);
  if (const std::string wrong = problem(next); !wrong.empty()) throw SceneError(wrong);

  BodyModelSet models = s.models;
  for (std::size_t i = 0; i < known; ++i)
    if (next.materials[i] != s.scene.materials[i]) models.set_material(int(i), next.materials[i]);
  const bool materials = models.all() != s.models.all();
  const bool solids = next.solids != s.scene.solids;
  const bool detection = next.method != s.scene.method || next.collision != s.scene.collision;
  const auto on_surfaces = [](const Scene& scene) { return scene.contact_surface == ContactSurface::surfaces; };
  const bool closer = on_surfaces(next) && !on_surfaces(s.scene) && s.frame > 0;
  Scene other_values = s.scene;
  for (const bool of_detection : {true, false}) copy_values(next, other_values, of_detection);
  const bool wakes = materials || solids || other_values != s.scene;
  Plan plan = make_plan(next, models.all(), s.added_bodies);
  if (detection) s.detect_anew(*this, next, plan);

  // Nothing throws from here on.
  const auto set_values = [&] {
    for (std::size_t i = 0; i < models.all().size(); ++i) {
      const auto &from = s.models.all()[i], &to = models.all()[i];
      if (from != to) s.solver.state().replace(from, to);
    }
    s.scene.gravity = next.gravity;
  };
  if (materials || next.gravity != s.scene.gravity) s.book_change(set_values);
  s.models = std::move(models);
  s.scene = std::move(next);
  s.plan = std::move(plan);
  s.solver.set_plan(s.plan);
  if (closer) s.solver.let_bodies_closer();
  for (BodyId b = 0; solids && b < s.particles.bodies.count(); ++b) s.solver.state().memory(b).may_lie_in_solid = true;
  if (wakes) s.wake_all();
}

std::size_t Snapshot::bytes() const {
  const Values& all = *values;
  return sizeof(*this) + sizeof(all) + bytes_of(all.world.scene.bodies) + bytes_of(all.world.arrived) +
         bytes_of(all.world.added) + all.solver.bytes();
}

Snapshot World::snapshot() const {
  const Parts& s = *parts_;
  return {.frame = s.frame,
          .grab = grabbed(),
          .values = std::make_shared<const Snapshot::Values>(Snapshot::Values{s, s.solver.save()})};
}

void World::restore(const Snapshot& snapshot) {
  assert(snapshot.values);
  Parts& s = *parts_;
  static_cast<WorldValues&>(s) = snapshot.values->world;
  s.settings = s.settings_of(s.scene);
  s.update_plan();
  s.set_integrator();  // without a check: the state may be one that a new scene would be refused for
  s.solver.restore(snapshot.values->solver);
  s.solver.hand().take(snapshot.grab);
  s.particles.detector = s.method().make();  // a new one: the old one caches another state
  s.count_vertices();
  s.update_positions();
  s.detect();
}

}  // namespace softbody
