#pragma once
// Finds what lies under the mouse.

#include <optional>

#include "app/render/drawn_positions.h"
#include "engine/camera.h"
#include "softbody/contact/solid_surface.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::render {

/// A point on the surface of a body.
struct Pick {
  softbody::BodyId body;
  softbody::Triangle corners;  // particles of the body, counted from its first, that hold the point
  glm::vec3 weights;           // barycentric, of the corners
  glm::vec3 point;             // m
  float distance;              // m, from the ray's origin
};

/// Returns the first triangle that the ray meets, from either side, of the bodies as they are drawn; nothing if it
/// meets none, or a solid first.
std::optional<Pick> pick(const engine::Ray& ray, const softbody::BodiesInMotion& world,
                         const DrawnPositions& positions);

/// Returns the distance (m) at which the ray meets the first body or solid; nothing if there is none.
std::optional<float> distance_to_scene(const engine::Ray& ray, const softbody::BodiesInMotion& world,
                                       const DrawnPositions& positions);

/// Where a ray enters a solid.
struct SolidPick {
  std::size_t index;  // in the scene
  double distance;    // m, from the ray's origin
};

/// Returns the solid that the ray enters first, within `max_distance` (m). It looks through a solid in which the ray
/// starts, as the drawing does.
std::optional<SolidPick> pick_solid(const engine::Ray& ray, const softbody::Scene& scene, double max_distance);

struct BoundingSphere {
  glm::vec3 centre;
  float radius;
};
/// Returns a sphere around a body as it is drawn.
BoundingSphere bounding_sphere(const softbody::BodiesInMotion& world, softbody::BodyId body,
                               const DrawnPositions& positions);

}  // namespace app::render
