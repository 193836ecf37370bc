#pragma once
// What lies under the mouse.

#include <optional>

#include "app/compare/drawn_positions.h"
#include "engine/camera.h"
#include "softbody/world.h"

namespace app {

/// A point on a triangle of a body.
struct Pick {
  softbody::BodyId body;
  softbody::Triangle corners;  // vertices of the body, counted from its first
  glm::vec3 weights;           // of the corners
  glm::vec3 point;             // m
  float distance;              // m, from the ray's origin
};

/// The first triangle that the ray meets, from either side, of the bodies as they are drawn; nothing if it meets none,
/// or a solid before.
std::optional<Pick> pick(const engine::Ray& ray, const softbody::World& world, const DrawnPositions& positions);

/// A sphere round a body as it is drawn.
struct BoundingSphere {
  glm::vec3 centre;
  float radius;
};
BoundingSphere bounding_sphere(const softbody::World& world, softbody::BodyId body, const DrawnPositions& positions);

}  // namespace app
