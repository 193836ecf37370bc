#include "softbody/world/measures.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

#include "softbody/contact/solid_overlap.h"
#include "softbody/integrate/force_stage.h"
#include "softbody/state/state.h"

namespace softbody {
namespace {

/// Returns the largest value on a segment or triangle of a function that is concave on it: on the places from `lo` to
/// `hi`.
double largest_of_concave(double lo, double hi, const auto& value) {
  constexpr double golden = 0.6180339887498949;
  constexpr int cuts = 32;
  double a = hi - golden * (hi - lo), b = lo + golden * (hi - lo), at_a = value(a), at_b = value(b);
  for (int i = 0; i < cuts; ++i)
    if (at_a > at_b)
      hi = b, b = a, at_b = at_a, a = hi - golden * (hi - lo), at_a = value(a);
    else
      lo = a, a = b, at_a = at_b, b = lo + golden * (hi - lo), at_b = value(b);
  return std::max(at_a, at_b);
}

/// Returns how deep (m) particles at x lie in a solid, and with `faces` also what is between them, if that is more than
/// `least`. A solid is convex, so that the depth in it is concave: along a face it stays below the planes that touch
/// it.
double deepest_in(const Solid& solid, const std::vector<glm::dvec3>& x, std::span<const Triangle> faces, double least) {
  const auto depth = [&](const glm::dvec3& p) { return -surface_at(solid, p).distance; };
  for (const glm::dvec3& p : x) least = std::max(least, depth(p));
  for (const auto& [i, j, k] : faces) {
    const glm::dvec3 &a = x[i], &b = x[j], &c = x[k], middle = (a + b + c) / 3.0;
    const SolidSurface s = surface_at(solid, middle);
    const double inwards =
        std::max({glm::dot(s.normal, middle - a), glm::dot(s.normal, middle - b), glm::dot(s.normal, middle - c)});
    constexpr double rounding = 1e-9;  // m
    if (!(inwards - s.distance > least + rounding)) continue;
    const auto across = [&](double u) {
      return largest_of_concave(0, 1, [&](double v) { return depth(glm::mix(a, glm::mix(b, c, u), v)); });
    };
    least = std::max(least, largest_of_concave(0, 1, across));
  }
  return least;
}

/// Returns the boxes of all bodies, by their ids. What is farther from a solid than these needs no closer look.
std::vector<PlacedBox> boxes_of(const State& state) {
  std::vector<PlacedBox> boxes(state.body_count());
  for (const Batch& b : state.batches()) {
    const Extent e = state.extent(b, state.x, state.v);
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
      const glm::dvec3 lo(e.lo[l]), hi(e.hi[l]);
      boxes[b.body[l]] = {state.body(b.body[l]).origin + 0.5 * (lo + hi), 0.5 * (hi - lo)};
    }
  }
  return boxes;
}

/// Returns how deep (m) a body in this box lies in solids. What contact sees counts: faces only if surfaces touch.
double deepest_in_solids(const World& world, BodyId id, const PlacedBox& box) {
  const BodyModel& model = world.model(id);
  std::vector<glm::dvec3> x;
  std::span<const Triangle> faces;
  if (world.scene().contact_surface == ContactSurface::surfaces) faces = model.mesh.triangles;
  double deepest = 0;
  for (const Solid& solid : world.scene().solids) {
    if (gap_before(solid, box) >= 0) continue;
    for (Index i = Index(x.size()); i < model.mesh.vertices.size(); ++i) x.push_back(world.particle(id, i).position);
    deepest = deepest_in(solid, x, faces, deepest);
  }
  return deepest;
}

/// Returns true if a body lies in one of the scene's solids, by more than rounding.
bool lies_in_solid(const World& world, BodyId id, const PlacedBody& body, const PlacedBox& box) {
  constexpr double rounding = 1e-4;  // m
  return deepest_in_solids(world, id, box) > rounding ||
         std::ranges::any_of(world.scene().solids, [&](const Solid& solid) {
           return overlap(body, solid, world.scene().contact_surface == ContactSurface::surfaces);
         });
}

}  // namespace

BodyMeasures measure(const World& world, BodyId id) { return measure(world.state(), id, world.scene().gravity); }

std::vector<BodyMeasures> measure_bodies(const World& world) {
  return measure_bodies(world.state(), world.scene().gravity);
}

const EnergyLedger& ledger(const World& world) { return world.state().ledger; }

std::vector<BodyId> overlapping_bodies(const World& world) {
  const collide::Frame now = world.simulated().positions;
  const BodyId count = world.bodies().count();
  const auto placed = [&](BodyId id) {
    const BodyModel& model = world.model(id);
    return PlacedBody{*model.surface, glm::dvec3(0.0), collide::vertices_of(now, id), model.mean_edge};
  };
  std::vector<PlacedBody> bodies;
  for (BodyId id = 0; id < count; ++id) bodies.push_back(placed(id));
  const std::vector<bool> overlaps = overlapping(bodies);
  const std::vector<PlacedBox> boxes = boxes_of(world.state());
  std::vector<BodyId> list;
  for (BodyId id = 0; id < count; ++id)
    if (overlaps[id] || lies_in_solid(world, id, bodies[id], boxes[id])) list.push_back(id);
  return list;
}

SolidDepth solid_depth(const Scene& scene, const glm::dvec3& point) {
  SolidDepth deepest{glm::vec3(0, 1, 0), -std::numeric_limits<double>::infinity()};
  for (const Solid& solid : scene.solids) {
    const SolidSurface s = surface_at(solid, point);
    if (-s.distance > deepest.depth) deepest = {glm::vec3(s.normal), -s.distance};
  }
  return deepest;
}

Measures total(std::span<const BodyMeasures> bodies) {
  Measures m;
  for (const BodyMeasures& b : bodies) {
    m.energies += b.energy;
    m.momentum += b.momentum;
    m.largest_strain = std::max(m.largest_strain, b.largest_strain);
    m.max_speed = std::max(m.max_speed, b.max_speed);
    m.finite = m.finite && b.finite;
    if (!b.closed) continue;
    m.volume_ratio_min = m.has_volume ? std::min(m.volume_ratio_min, b.volume_ratio) : b.volume_ratio;
    m.volume_ratio_max = m.has_volume ? std::max(m.volume_ratio_max, b.volume_ratio) : b.volume_ratio;
    m.has_volume = true;
  }
  m.energy = m.energies.total();
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!m.finite) m.volume_ratio_min = m.volume_ratio_max = m.largest_strain = m.max_speed = unknown;
  return m;
}

double safe_vertex_tolerance(const World& world) {
  if (!world.plan().has(stage_of<PenaltyContact>)) return 0;
  double widest = 0;
  for (BodyId body = 0; body < world.bodies().count(); ++body) widest = std::max(widest, world.model(body).covering);
  return widest;
}

std::vector<SolidContactPoint> solid_contacts(const World& world) {
  constexpr double rounding = 1e-4;  // m: where a particle rests on a solid it keeps its thickness only up to rounding
  const collide::Frame at = world.simulated().positions;
  std::vector<SolidContactPoint> contacts;
  const std::vector<PlacedBox> boxes = boxes_of(world.state());
  for (BodyId body = 0; body < boxes.size(); ++body) {
    const double distance = world.model(body).material[Material::thickness] + rounding;
    const auto is_near = [&](const Solid& solid) { return gap_before(solid, boxes[body]) < distance; };
    if (std::ranges::none_of(world.scene().solids, is_near)) continue;
    for (Index i = 0; i < at.bodies->size(body); ++i) {
      const SolidDepth d = solid_depth(world.scene(), world.particle(body, i).position);
      if (d.depth > -distance) contacts.push_back({at.bodies->first[body] + i, d.normal});
    }
  }
  return contacts;
}

Measures measure(const World& world) { return measure(world, measure_bodies(world)); }

Measures measure(const World& world, std::span<const BodyMeasures> bodies) {
  Measures m = total(bodies);
  if (!m.finite) {
    m.deepest_penetration = std::numeric_limits<double>::quiet_NaN();
    return m;
  }
  const std::vector<PlacedBox> boxes = boxes_of(world.state());
  for (BodyId id = 0; id < boxes.size(); ++id)
    m.deepest_penetration = std::max(m.deepest_penetration, deepest_in_solids(world, id, boxes[id]));
  return m;
}

}  // namespace softbody
