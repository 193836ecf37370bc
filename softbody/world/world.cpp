#include <algorithm>
#include <cassert>
#include <chrono>
#include <set>
#include <utility>

#include "softbody/contact/solid_surface.h"
#include "softbody/integrate/force_stage.h"
#include "softbody/mesh/shortest_text.h"
#include "softbody/state/rigid_motion.h"
#include "softbody/world/measures.h"
#include "softbody/world/world_parts.h"

namespace softbody {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Returns the automatic cell size for the bodies at rest.
glm::vec3 rest_cell_size(const BodyModelSet& models, int levels, float tolerance) {
  collide::Bodies bodies;
  Coordinates rest;
  for (const auto& model : models.all()) {
    bodies.add(std::make_shared<collide::Shape>(model->shown().shape->shared_topology()));  // without a shape at rest
    rest.add(model->shown_at_rest());
  }
  return collide::automatic_cell_size(rest.input(bodies), levels, tolerance);
}

}  // namespace

WorldValues::WorldValues(Scene s, const IntegratorChoice& integrator)
    : scene(std::move(s)), models(scene), arrived(scene.bodies.size(), false), choice(integrator) {}

World::Parts::Parts(Scene s, const Options& o)
    : WorldValues(std::move(s), o.integrator),
      check_work(o.check_work),
      frame_time(o.frame_time),
      workers(o.threads, o.least_share),
      plan(make_plan(scene, models.all())),
      solver(scene, BatchShares(workers)) {
  particles.detector = method().make();
  solver.steps().set_budget(o.budget);
  solver.set_max_candidates(o.max_candidates);
  solver.set_vertices(particles.bodies);
  solver.set_plan(plan);
  check_sizes(models, choice);
  for (const BodySource& source : scene.bodies) held_vertices(source);
  set_integrator();
  arrive();
  update_positions();
  detect();
}

/// Hands the integrator on to the solver, without a check.
void World::Parts::set_integrator() {
  report.integrator = &choice.integrator();
  report.why = {};
  solver.steps().set_choice(choice);
}

/// Throws SceneError if one of these models has too many particles for this integrator.
void World::Parts::check_sizes(const BodyModelSet& all, const IntegratorChoice& wanted) const {
  if (!wanted.integrator().implicit) return;
  for (const auto& p : all.all())
    if (const auto count = p->mesh.vertices.size(); count > max_implicit_particles)
      throw SceneError("scene '" + scene.key + "': a body of " + std::to_string(count) +
                       " vertices has too large a matrix for implicit steps (at most " +
                       std::to_string(max_implicit_particles) + " vertices); choose another integrator");
}

/// Returns the particles that carry what the holds of a body hold. Throws SceneError if one holds nothing.
std::vector<HeldVertices> World::Parts::held_vertices(const BodySource& source) const {
  constexpr double rounding = 1e-9;  // m
  std::vector<HeldVertices> list;
  if (source.holds.empty()) return list;
  const BodyModel& model = *models.of(source);
  const std::vector<glm::dvec3> places = turned(model.shown_at_rest(), source.axes);
  const auto fail = [&](const std::string& what) {
    std::string at;
    for (int k = 0; k < 3; ++k) at += (k > 0 ? ", " : "") + shortest_text(source.position[k]);
    throw SceneError("scene '" + scene.key + "': hold[" + std::to_string(list.size()) + "] of the body at [" + at +
                     "] holds " + what);
  };
  for (const Hold& h : source.holds) {
    std::set<Index> found(h.vertices.begin(), h.vertices.end());
    const std::size_t count = model.mesh.vertices.size();
    if (!found.empty() && *found.rbegin() >= count)
      fail("vertex " + std::to_string(*found.rbegin()) + "; the last one is " + std::to_string(count - 1));
    for (Index vertex = 0; h.vertices.empty() && vertex < places.size(); ++vertex) {
      if (surface_at(Solid{h.where}, source.position + places[vertex]).distance > rounding) continue;
      if (!model.fine) found.insert(vertex);
      for (std::size_t k = 0; model.fine && k < 3; ++k) found.insert(model.fine->embedding()[vertex].corner[k]);
    }
    if (found.empty())
      fail(
          "no vertex; put it where the body, and each copy of a lattice, has some when it appears, in the world's "
          "coordinates");
    list.push_back({{found.begin(), found.end()},
                    h.velocity,
                    h.turn.vector(),
                    h.through,
                    std::max(h.from, source.appear),
                    h.until});
  }
  return list;
}

BodyId World::Parts::add(const BodySource& source, const glm::dvec3& position) {
  const auto& model = models.of(source);
  std::vector<HeldVertices> holds = held_vertices(source);
  const BodyId id = solver.state().add(model, position, source.velocity, source.axes, source.spin.vector());
  solver.state().memory(id).holds = std::move(holds);
  switch_holds(id);
  if (model->fine && !fine) {
    count_vertices();  // the first one: the bodies before it are shown as they are
  } else {
    particles.add(model->shape);
    if (fine) fine->add(model->shown().shape);
  }
  EnergyLedger& ledger = solver.state().ledger;
  ledger.book(WorkBy::user, measure(solver.state(), id, scene.gravity).conserved(ledger.staggering));
  return id;
}

void World::Parts::arrive() {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodySource& source = scene.bodies[i];
    if (arrived[i] || source.appear > frame) continue;
    arrived[i] = true;
    const BodyId id = add(source, source.position);
    solver.state().memory(id).source = int(i);
    if (source.release <= frame) continue;
    solver.state().set_pinned(id, true);
    solver.state().memory(id).release = source.release;
  }
  for (BodyId b = 0; b < particles.bodies.count(); ++b) {
    const Body& body = solver.state().body(b);
    if (body.pinned && body.memory.release <= frame) solver.state().set_pinned(b, false);
    switch_holds(b);
  }
}

/// Lets the holds of a body begin and end in this frame.
void World::Parts::switch_holds(BodyId body) {
  for (HeldVertices& h : solver.state().memory(body).holds) {
    const bool on = h.from <= frame && (h.until == 0 || h.until > frame);
    if (std::exchange(h.on, on) != on) solver.state().set_asleep(body, false);
  }
}

/// Returns the settings of a detection by this scene, with the cell size.
collide::Settings World::Parts::settings_of(const Scene& of) const {
  collide::Settings all = of.collision;
  if (!all.cell_size) all.cell_size = rest_cell_size(models, all.levels, all.tolerance);
  return all;
}

/// Counts bodies and their vertices anew from the solver's state.
void World::Parts::count_vertices() {
  const State& state = solver.state();
  particles.bodies = {}, particles.vertex_body.clear();
  fine.reset();
  for (BodyId id = 0; id < state.body_count(); ++id) {
    particles.add(state.model(id).shape);
    if (state.model(id).fine) fine.emplace();
  }
  if (!fine) return;
  fine->detector = method().make();
  for (BodyId id = 0; id < state.body_count(); ++id) fine->add(state.model(id).shown().shape);
}

void World::Parts::update_positions() {
  const Field<float> places = particles.positions.resized(particles.bodies.vertex_count());
  for (const Batch& b : solver.state().batches()) solver.state().write_positions(b, particles.bodies.first, places);
  place_fine_meshes();
}

/// Lets the meshes that are shown follow the particles.
void World::Parts::place_fine_meshes() {
  if (!fine) return;
  const Field<float> places = fine->positions.resized(fine->bodies.vertex_count());
  constexpr double vertex_ns = 20;  // of work
  const int threads = workers.threads_for(vertex_ns * double(fine->bodies.vertex_count()));
  workers.share(threads, particles.bodies.count(), [&](int thread, std::size_t body) {
    const auto id = BodyId(body);
    const collide::VertexRun from = collide::vertices_of(particles.input(), id);
    const Field<float> to = places + fine->bodies.first[id];
    const std::size_t size = fine->bodies.size(id);
    if (const auto& mesh = solver.state().model(id).fine)
      mesh->embedding().place({{from.x, from.size}, {from.y, from.size}, {from.z, from.size}}, {to.x, size},
                              {to.y, size}, {to.z, size}, placing[std::size_t(thread)]);
    else
      for (const auto& [source, target] : {std::pair(from.x, to.x), {from.y, to.y}, {from.z, to.z}})
        std::copy_n(source, size, target);
  });
}

void World::Parts::detect() {
  const auto start = Clock::now();
  for_each_meshes([&](DetectedMeshes& meshes) {
    if (plan.has(Stage::detect))
      meshes.detector->detect(meshes.input(), settings, workers, meshes.result);
    else
      meshes.result = {};
  });
  report.detect_ms = ms_since(start);
}

/// Finds the contacts by another method or with other settings, those of `next`. Changes nothing if it throws.
void World::Parts::detect_anew(const World& world, const Scene& next, const Plan& next_plan) {
  const collide::Method& another = *collide::find_method(next.method);
  const collide::Settings others = settings_of(next);
  if (check_work) check_work(world, another, others);
  const auto start = Clock::now();
  std::vector<Detection> found;
  for_each_meshes([&](DetectedMeshes& meshes) {
    Detection& one = found.emplace_back(Detection{another.make(), {}});
    if (next_plan.has(Stage::detect)) one.detector->detect(meshes.input(), others, workers, one.result);
  });
  report.detect_ms = ms_since(start);
  settings = others;
  std::size_t next_one = 0;
  for_each_meshes([&](Detection& meshes) { meshes = std::move(found[next_one++]); });
}

void World::Parts::wake_all() {
  for (BodyId b = 0; b < particles.bodies.count(); ++b)
    if (solver.state().body(b).asleep) solver.state().set_asleep(b, false);
}

World::World(Scene scene, const Options& options) : parts_(new Parts(std::move(scene), options)) {}
void World::DeleteParts::operator()(Parts* parts) const { delete parts; }

void World::step(const std::function<void()>& after_substep) {
  Parts& s = *parts_;
  const auto start = Clock::now();
  if (s.plan.has(Stage::arrive)) s.arrive();
  DetectedMeshes& touching = s.particles;
  if (const auto& grab = grabbed()) s.solver.state().set_asleep(grab->body, false);  // a grabbed body stays awake
  ++s.frame;
  if (s.plan.has(Stage::sleep))
    wake_touched(s.scene.sleep, s.solver.state(), touching.vertex_body, touching.result.contacts);
  const bool penalty = s.plan.has(stage_of<PenaltyContact>);
  if (penalty)
    s.solver.set_contacts({touching.bodies, touching.vertex_body, touching.result.contacts, s.settings.tolerance},
                          s.frame_time);
  double looking_ms = 0;
  const auto look = [&] {
    const auto from = Clock::now();
    s.update_positions();
    after_substep();
    looking_ms += ms_since(from);
  };
  const FrameResult done = s.solver.advance(s.frame_time, after_substep ? look : std::function<void()>());
  s.solver.finish_frame(done.seconds, touching.positions.resized(touching.bodies.vertex_count()));
  s.place_fine_meshes();
  s.report.time += done.seconds;
  s.report.seconds = done.seconds;
  const StepPlan& steps = s.solver.steps().plan();
  s.report.substeps = done.substeps;
  s.report.needed = done.needed;
  s.report.last_substep = s.solver.last_substep();
  s.report.integrator = steps.integrator;
  s.report.why = steps.why;
  const bool whole = done.seconds == s.frame_time;
  s.report.solve_ms = ms_since(start) - looking_ms;
  s.detect();
  const bool penalty_grows = penalty && s.solver.penalty_contact().layer().grows();  // nobody falls asleep meanwhile
  if (s.plan.has(Stage::sleep) && whole && !penalty_grows)
    settle(s.scene.sleep, s.solver.state(), touching.vertex_body, touching.result.contacts,
           s.solver.surface_contact().candidates().interactions());
  s.report.total_ms = ms_since(start) - looking_ms;
}

void World::set_particles(BodyId body, std::span<const Particle> particles) {
  Parts& s = *parts_;
  assert(particles.size() == s.particles.bodies.size(body));
  s.book_change([&] { s.solver.state().set_particles(body, particles); });
  s.solver.state().memory(body).may_lie_in_solid = true;
  s.solver.forget_impacts(body);
  s.wake_all();
  s.update_positions();
  s.detect();
}

const Scene& World::scene() const { return parts_->scene; }
int World::frame() const { return parts_->frame; }
double World::frame_time() const { return parts_->frame_time; }
const Plan& World::plan() const { return parts_->plan; }
const collide::Settings& World::collision() const { return parts_->settings; }
glm::vec3 World::automatic_cell_size(int levels) const {
  return rest_cell_size(parts_->models, levels, parts_->settings.tolerance);
}
const collide::Method& World::method() const { return parts_->method(); }

void World::set_integrator(const IntegratorChoice& choice) {
  Parts& s = *parts_;
  s.check_sizes(s.models, choice);
  s.choice = choice;
  s.set_integrator();
  s.wake_all();
}

const IntegratorChoice& World::integrator_choice() const { return parts_->choice; }

const collide::Bodies& World::bodies() const { return parts_->shown().bodies; }
collide::Frame World::positions() const { return parts_->shown().input(); }
SimulatedMeshes World::simulated() const { return {parts_->particles.input(), parts_->particles.result.contacts}; }
const BodyModel& World::model(BodyId body) const { return parts_->solver.state().model(body); }
Particle World::particle(BodyId body, Index vertex) const { return parts_->solver.state().particle(body, vertex); }
const collide::Result& World::detection() const { return parts_->shown().result; }
const collide::Detector& World::detector() const { return *parts_->shown().detector; }
const State& World::state() const { return parts_->solver.state(); }
std::uint64_t World::state_hash() const { return parts_->solver.state().hash(); }
const StepReport& World::last_step() const { return parts_->report; }

BodyState World::body(BodyId body) const { return parts_->solver.state().body(body); }

std::vector<SurfaceContactPoint> World::surface_contacts() const {
  return parts_->solver.surface_contact().contact_points(parts_->particles.bodies);
}

bool World::all_at_rest() const {
  const Parts& s = *parts_;
  if (std::find(s.arrived.begin(), s.arrived.end(), char(false)) != s.arrived.end()) return false;
  // The holds of the frame at hand begin and end in the next step.
  const auto changes = [&](const HeldVertices& h) { return std::max(h.from, h.until) >= s.frame; };
  for (BodyId b = 0; b < s.particles.bodies.count(); ++b) {
    const Body& body = s.solver.state().body(b);
    if (!body.asleep || std::ranges::any_of(body.memory.holds, changes)) return false;
  }
  return true;
}

}  // namespace softbody
