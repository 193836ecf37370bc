#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "softbody/mesh/mesh.h"

namespace softbody {

using BodyId = std::uint32_t;

struct Particle {
  glm::dvec3 position, velocity;  // m and m/s, in the world
};

/// State of a body as a whole.
struct BodyState {
  std::uint32_t number = 0;  // stays the same when bodies before it are removed and ids move up
  glm::dvec3 origin{0.0};    // m; places of particles are stored relative to it, so that floats stay fine far from zero
  bool pinned = false;       // held in place until the frame that its BodySource names
  bool asleep = false;
  bool moves() const { return !pinned && !asleep; }
};

}  // namespace softbody
