#pragma once
// What tests of hands on the world share.

#include <glm/vec3.hpp>

#include "app/session/session.h"
#include "tests/app/scenes.h"

namespace app {

/// touching_pair() a little apart, in empty space without gravity.
inline softbody::Scene without_solids() {
  softbody::Scene scene = touching_pair();
  scene.solids.clear();
  scene.bodies[0].position.x = -0.8;
  scene.bodies[1].position.x = 0.8;
  scene.gravity = glm::dvec3(0.0);
  return scene;
}

inline glm::dvec3 centre(const softbody::BodiesInMotion& world, softbody::BodyId id) {
  glm::dvec3 sum(0.0);
  const collide::Index first = world.bodies().first[id], count = world.bodies().size(id);
  for (collide::Index i = 0; i < count; ++i) {
    const collide::Frame f = world.positions();
    sum += glm::dvec3(f.x[first + i], f.y[first + i], f.z[first + i]) / double(count);
  }
  return sum;
}

}  // namespace app
