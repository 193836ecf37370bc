#pragma once
// Finds what lies under the mouse.

#include <optional>

#include "app/compare/drawn_positions.h"
#include "engine/camera.h"
#include "softbody/world.h"

namespace app::render {

/// A point on a triangle of a body.
struct Pick {
  softbody::BodyId body;
  softbody::Triangle corners;  // vertices of the body, counted from its first
  glm::vec3 weights;           // barycentric, of the corners
  glm::vec3 point;             // m
  float distance;              // m, from the ray's origin
};

/// Returns the first triangle that the ray meets, from either side, of the bodies as they are drawn; nothing if it
/// meets none, or a solid first.
std::optional<Pick> pick(const engine::Ray& ray, const softbody::World& world,
                         const compare::DrawnPositions& positions);

/// Returns the distance (m) at which the ray meets the first body or solid; nothing if there is none.
std::optional<float> distance_to_scene(const engine::Ray& ray, const softbody::World& world,
                                       const compare::DrawnPositions& positions);

struct BoundingSphere {
  glm::vec3 centre;
  float radius;
};
/// Returns a sphere around a body as it is drawn.
BoundingSphere bounding_sphere(const softbody::World& world, softbody::BodyId body,
                               const compare::DrawnPositions& positions);

}  // namespace app::render
