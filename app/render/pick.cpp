#include "app/render/pick.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/model/body_model.h"

namespace app::render {
namespace {

struct Hit {
  float distance;
  glm::vec3 weights;
};

/// Intersects a ray with a triangle, from both sides (Möller and Trumbore 1997).
std::optional<Hit> meet(const engine::Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 ab = b - a, ac = c - a, across = glm::cross(ray.direction, ac);
  const float determinant = glm::dot(ab, across);
  if (determinant == 0) return std::nullopt;
  const glm::vec3 from = ray.origin - a, turned = glm::cross(from, ab);
  const float u = glm::dot(from, across) / determinant, v = glm::dot(ray.direction, turned) / determinant;
  const float distance = glm::dot(ac, turned) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) return std::nullopt;
  return Hit{distance, {1 - u - v, u, v}};
}

/// Returns true if the ray's line meets the sphere.
bool passes(const engine::Ray& ray, const BoundingSphere& sphere) {
  return glm::length(glm::cross(sphere.centre - ray.origin, ray.direction)) <= sphere.radius;
}

/// Returns the distance (m) at which the ray enters a solid, at most `max_distance`, by sphere tracing.
double entry_distance(const engine::Ray& ray, const softbody::Solid& solid, double max_distance) {
  constexpr double hit_distance = 1e-3;  // m
  constexpr int max_steps = 300;
  double along = 0;
  for (int i = 0; i < max_steps && along < max_distance; ++i) {
    const glm::dvec3 at = glm::dvec3(ray.origin) + along * glm::dvec3(ray.direction);
    const double away = softbody::surface_at(solid, at).distance;
    if (i == 0 && away <= 0) return max_distance;
    if (away < hit_distance) return along;
    along += away;
  }
  return max_distance;
}

/// Where a fine mesh is drawn, names the particles that hold its vertex nearest to the point.
void hold_by_particles(Pick& pick, const softbody::BodyModel& model) {
  if (!model.fine) return;
  int nearest = 0;
  for (const int k : {1, 2})
    if (pick.weights[k] > pick.weights[nearest]) nearest = k;
  const softbody::Embedding::Hold& hold = model.fine->embedding()[pick.corners[static_cast<std::size_t>(nearest)]];
  pick.corners = hold.corner;
  pick.weights = hold.weight;
}

}  // namespace

std::optional<SolidPick> pick_solid(const engine::Ray& ray, const softbody::Scene& scene, double max_distance) {
  SolidPick nearest{scene.solids.size(), max_distance};
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const double distance = entry_distance(ray, scene.solids[i], nearest.distance);
    if (distance < nearest.distance) nearest = {i, distance};
  }
  return nearest.distance < max_distance ? std::optional(nearest) : std::nullopt;
}

BoundingSphere bounding_sphere(const softbody::BodiesInMotion& world, softbody::BodyId body,
                               const DrawnPositions& positions) {
  const collide::Index first = world.bodies().first[body], end = world.bodies().first[body + 1];
  glm::vec3 lo = positions[first], hi = lo;
  for (collide::Index i = first; i < end; ++i) {
    lo = glm::min(lo, positions[i]);
    hi = glm::max(hi, positions[i]);
  }
  const glm::vec3 centre = 0.5f * (lo + hi);
  float radius2 = 0;
  for (collide::Index i = first; i < end; ++i) {
    const glm::vec3 away = positions[i] - centre;
    radius2 = std::max(radius2, glm::dot(away, away));
  }
  return {centre, std::sqrt(radius2)};
}

std::optional<Pick> pick(const engine::Ray& ray, const softbody::BodiesInMotion& world,
                         const DrawnPositions& positions) {
  std::optional<Pick> nearest;
  for (softbody::BodyId body = 0; body < world.bodies().count(); ++body) {
    if (!passes(ray, bounding_sphere(world, body, positions))) continue;
    const collide::Index first = world.bodies().first[body];
    for (const softbody::Triangle& t : world.model(body).shown().mesh.triangles) {
      const auto hit = meet(ray, positions[first + t[0]], positions[first + t[1]], positions[first + t[2]]);
      if (!hit || (nearest && hit->distance >= nearest->distance)) continue;
      nearest = Pick{body, t, hit->weights, ray.origin + hit->distance * ray.direction, hit->distance};
    }
  }
  if (nearest) hold_by_particles(*nearest, world.model(nearest->body));
  if (nearest && pick_solid(ray, world.scene(), double{nearest->distance})) return std::nullopt;
  return nearest;
}

std::optional<float> distance_to_scene(const engine::Ray& ray, const softbody::BodiesInMotion& world,
                                       const DrawnPositions& positions) {
  constexpr double horizon = 1e3;  // m
  if (const auto body = pick(ray, world, positions)) return body->distance;
  const auto solid = pick_solid(ray, world.scene(), horizon);
  return solid ? std::optional(static_cast<float>(solid->distance)) : std::nullopt;
}

}  // namespace app::render
