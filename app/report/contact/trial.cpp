#include "app/report/contact/results.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/compare/world_oracle.h"
#include "app/files/inputs.h"
#include "app/report/solid_passages.h"
#include "app/report/worlds.h"
#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

double smallest_closed_radius(const softbody::World& world) {
  double radius = 0;
  for (collide::Index b = 0; b < world.bodies().count(); ++b) {
    const softbody::BodyModel& model = world.model(b);
    if (model.mesh.closed && (radius == 0 || model.radius < radius)) radius = model.radius;
  }
  return radius;
}

/// A run, and what is measured on the way.
class Trial {
 public:
  Trial(softbody::Scene scene, const TrialLimits& limits, ContactTrial& result)
      : limits_(limits), result_(result), world_(std::move(scene), {.threads = 1}) {
    result_.settles = world_.scene().gravity != glm::dvec3(0.0);
    result_.tolerance = double{world_.collision().tolerance};
    oracle_.crossings(world_);
    remember_middles();
    passages_.observe(world_);
  }

  void run() {
    const double start = thread_seconds();
    while (world_.frame() < limits_.frames && result_.finite && !world_.all_at_rest()) {
      step();
      if (thread_seconds() - start > limits_.seconds) {
        result_.not_run = fmt::format("over the budget of {:g} s after {} frames", limits_.seconds, world_.frame());
        return;
      }
    }
    finish();
  }

 private:
  void step() {
    result_.radius = smallest_closed_radius(world_);
    const double start = thread_seconds();
    double looking = 0;  // s
    const double wall_ms = time_ms([&] {
      world_.step([&] {
        const double from = thread_seconds();
        look_for_passages(straight_way);
        looking += thread_seconds() - from;
      });
    });
    const double processor = thread_seconds() - start;
    require_whole_frame(world_);
    result_.timed += {.wall = 1e-3 * wall_ms, .processor = processor};
    result_.cpu_ms += 1e3 * (processor - looking);
    result_.detect_ms += world_.last_step().detect_ms;
    result_.solve_ms += world_.last_step().solve_ms;
    look_for_passages(rest_way);
    if (!passages_.observe(world_)) result_.finite = false;
    result_.through_solids = passages_.count();
    if (world_.frame() > limits_.frames - last_second) look_at_speeds();
    if (world_.frame() % limits_.stride == 0) look_for_overlaps();
  }

  void finish() {
    look_for_passages(0);
    look_for_overlaps();
    result_.frames = world_.frame();
    result_.bodies = world_.bodies().count();
    result_.vertices = world_.bodies().vertex_count();
    result_.asleep = world_.all_at_rest();
    const double frames = std::max(1, world_.frame());
    for (double* sum : {&result_.cpu_ms, &result_.detect_ms, &result_.solve_ms}) *sum /= frames;
    if (result_.penetrations > 0) result_.mean_depth = depths_ / double(result_.penetrations);
    if (awake_particles_ > 0 && !result_.asleep) result_.jitter = std::sqrt(squares_ / awake_particles_);
  }

  /// Looks for passages if a vertex has moved by `min_way` (m) since the last look.
  void look_for_passages(double min_way) {
    if (oracle_.max_displacement(world_) < min_way) return;
    const std::vector<collide::oracle::Crossing> crossings = oracle_.crossings(world_);
    const auto figures = collide::oracle::figures_of(world_.simulated().positions, {}, crossings);
    result_.passed += passed(crossings);
    result_.crossed_vertices += figures.crossed_vertices;
    result_.edge_crossings += figures.edge_crossings;
    remember_middles();
  }

  /// Counts vertices that came to be inside a closed body, or on the other side of an open surface or their own. The
  /// straight line from one look to the next cuts the corners of a curved path. So a vertex that went in and out again
  /// counts as having stayed outside, unless the two bodies passed each other by more than the smallest body's radius.
  std::size_t passed(const std::vector<collide::oracle::Crossing>& crossings) const {
    std::map<std::pair<collide::Index, collide::Index>, int> balance;  // by vertex and the other body
    std::set<collide::Index> vertices;
    for (const collide::oracle::Crossing& c : crossings) {
      if (c.kind != collide::oracle::Crossing::Kind::vertex_face) continue;
      if (glm::distance(way_of(c.body), way_of(c.other)) > result_.radius) vertices.insert(c.feature[0]);
      if (!world_.model(c.other).mesh.closed || c.body == c.other)
        balance[{c.feature[0], c.other}] += c.inward ? 1 : -1;
      else if (oracle_.entered_body(c))
        vertices.insert(c.feature[0]);
    }
    for (const auto& [key, sum] : balance)
      if (sum != 0) vertices.insert(key.first);
    return vertices.size();
  }

  /// Returns the way of a body's middle since the last look for passages.
  glm::dvec3 way_of(collide::Index body) const {
    return body < middles_.size() ? middle_of(world_.simulated().positions, body) - middles_[body] : glm::dvec3(0.0);
  }

  void look_for_overlaps() {
    const softbody::Measures measures = softbody::measure(world_);
    result_.finite = result_.finite && measures.finite;
    result_.solid_depth = std::max(result_.solid_depth, measures.deepest_penetration);
    const softbody::SimulatedMeshes simulated = world_.simulated();
    const collide::oracle::Overlaps overlaps = oracle_.overlaps(world_);
    const auto figures = collide::oracle::figures_of(simulated.positions, overlaps);
    const auto missed =
        collide::oracle::missed_by(simulated.contacts, simulated.positions, compare::surfaces_of(world_), overlaps);
    ++result_.looks;
    result_.penetrations += overlaps.penetrations.size();
    result_.missed += missed.penetrations.size();
    result_.deepest = std::max(result_.deepest, figures.deepest);
    depths_ += figures.mean_depth * double(overlaps.penetrations.size());
    result_.end_depth = figures.deepest;
    result_.overlapping_pairs = figures.overlapping_pairs;
    result_.self_intersecting = figures.self_intersecting_bodies;
  }

  void remember_middles() {
    middles_.clear();
    const collide::Frame at = world_.simulated().positions;
    for (collide::Index b = 0; b < at.bodies->count(); ++b) middles_.push_back(middle_of(at, b));
  }

  void look_at_speeds() {
    for (collide::Index b = 0; b < world_.bodies().count(); ++b) {
      if (world_.body(b).asleep) continue;
      squares_ += 2 * softbody::measure(world_, b).energy.kinetic / world_.model(b).particle_mass;
      awake_particles_ += world_.simulated().positions.bodies->size(b);
    }
  }

  static constexpr int last_second = 60;  // frames
  // The way (m) of a vertex from which on passages are looked for. After a substep: a way that is still straight, a
  // tenth of the radius of the scenes' spheres. After a frame: the bound of their depth.
  static constexpr double straight_way = 0.05, rest_way = 0.01;

  const TrialLimits& limits_;
  ContactTrial& result_;
  softbody::World world_;
  compare::WorldOracle oracle_{1};
  std::vector<glm::dvec3> middles_;  // of the bodies, at the last look for passages
  SolidPassages passages_;
  double depths_ = 0, squares_ = 0, awake_particles_ = 0;
};

// ---- impacts ----

constexpr double ball_radius = 0.5, gap = 0.3;  // m

/// Returns scene A without gravity and solids, in which only a ball flies down to the origin, a little off the middle.
/// `top`: height of what is there.
softbody::Scene thrown_ball(std::string key, std::string name, double top, double speed) {
  softbody::Scene scene = softbody::find_scene("A", files::scene_folder());
  scene.key = std::move(key);
  scene.name = std::move(name);
  scene.gravity = glm::dvec3(0.0);
  scene.solids.clear();
  scene.bodies.assign(1, {});
  scene.bodies[0].mesh.radius = ball_radius;
  scene.bodies[0].position = {0.04, top + gap + ball_radius, 0.03};
  scene.bodies[0].velocity = {0, -speed, 0};
  return scene;
}

/// Puts a body at the origin, at rest.
softbody::BodySource& add_target(softbody::Scene& scene) {
  softbody::BodySource& target = *scene.bodies.insert(scene.bodies.begin(), softbody::BodySource());
  target.position = glm::dvec3(0.0);
  return target;
}

softbody::Scene at_sphere(double speed) {
  softbody::Scene scene = thrown_ball("sphere", "A sphere thrown at a resting sphere", ball_radius, speed);
  add_target(scene).mesh.radius = ball_radius;
  return scene;
}

softbody::Scene at_solid(double speed) {
  const softbody::SolidSphere sphere;
  softbody::Scene scene = thrown_ball("solid", "A sphere thrown at the solid sphere", sphere.radius, speed);
  scene.solids = {{sphere}};
  return scene;
}

softbody::Scene at_sheet(double speed) {
  softbody::Scene scene = thrown_ball("sheet", "A sphere thrown at a hanging sheet", 0, speed);
  scene.materials.push_back(softbody::find_scene("cloth", files::scene_folder()).materials.front());
  softbody::BodySource& sheet = add_target(scene);
  sheet.mesh = {.kind = "grid", .columns = 24, .rows = 24, .width = 2, .depth = 2};
  sheet.material = 1;
  return scene;
}

}  // namespace

std::span<const Impact> impacts() {
  static constexpr std::array all{at_sphere, at_solid, at_sheet};
  return all;
}

std::vector<std::string> ContactTrial::failures() const {
  std::vector<std::string> all;
  if (!was_run()) return {not_run};
  if (!finite) all.push_back("not finite");
  if (through_solids > 0) all.push_back(fmt::format("through a solid: {}", through_solids));
  if (radius > 0 && solid_depth > depth_bound * radius)
    all.push_back(fmt::format("{:.2g} R deep in a solid", solid_depth / radius));
  if (passed > 0) all.push_back(fmt::format("passed: {}", passed));
  if (end_depth > depth_bound * radius) all.push_back(fmt::format("{:.2g} R deep at the end", end_depth / radius));
  if (self_intersecting > 0) all.push_back(fmt::format("pierce themselves: {}", self_intersecting));
  if (settles && !asleep) all.push_back("awake");
  return all;
}

ContactTrial run_contact_trial(softbody::Scene scene, const ContactChoice& choice, const TrialLimits& limits) {
  ContactTrial result{.choice = choice};
  scene.contact_surface = choice.surface;
  scene.method = choice.method;
  scene.collision.tolerance *= float(choice.tolerance);
  try {
    Trial(std::move(scene), limits, result).run();
  } catch (const softbody::SceneError& error) {
    result.not_run = error.what();
  }
  return result;
}

}  // namespace app::report
