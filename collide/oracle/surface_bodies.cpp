#include "collide/oracle/surface_bodies.h"

#include <cmath>
#include <stdexcept>

namespace collide::oracle {

void require_match(const Frame& frame, const surface::Surfaces& surfaces) {
  const Bodies& bodies = *frame.bodies;
  if (surfaces.size() != bodies.count()) throw std::invalid_argument("surfaces: there must be one for each body");
  for (Index body = 0; body < bodies.count(); ++body) {
    if (surfaces[body] && surfaces[body]->vertex_count() != bodies.size(body)) {
      throw std::invalid_argument("surfaces: each must have as many vertices as its body");
    }
  }
}

surface::Box box_of_body(const Frame& frame, Index body) {
  surface::Box box;
  for (Index v = frame.bodies->first[body]; v < frame.bodies->first[body + 1]; ++v) {
    const glm::vec3 p = position(frame, v);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return {};
    box.add(glm::dvec3(p));
  }
  return box;
}

}  // namespace collide::oracle
