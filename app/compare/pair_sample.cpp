#include "app/compare/pair_sample.h"

#include <algorithm>
#include <random>

#include <glm/common.hpp>

namespace app::compare {

void PairSample::draw(const collide::Frame& frame, bool self_collision) {
  constexpr collide::Index small = 128;        // vertices of a frame of which all pairs are taken
  constexpr std::size_t some = small * small;  // pairs of another frame
  apart_.clear();
  drawn_ = 0;
  const collide::Bodies& bodies = *frame.bodies;
  const auto add = [&](collide::Index a, collide::Index b) {
    ++drawn_;
    if (!self_collision && bodies.body_of(a) == bodies.body_of(b)) return;
    apart_.push_back(
        glm::abs(glm::dvec3(frame.x[a], frame.y[a], frame.z[a]) - glm::dvec3(frame.x[b], frame.y[b], frame.z[b])));
  };
  const collide::Index count = bodies.vertex_count();
  if (count <= small) {
    for (collide::Index a = 0; a < count; ++a)
      for (collide::Index b = a + 1; b < count; ++b) add(a, b);
    return;
  }
  std::mt19937 random(1);
  while (drawn_ < some) {
    const auto a = static_cast<collide::Index>(random() % count), b = static_cast<collide::Index>(random() % count);
    if (a != b) add(a, b);
  }
}

double PairSample::share(const glm::dvec3& cell, const glm::dvec3& reach) const {
  double meet = 0;
  for (const glm::dvec3& apart : apart_) {
    const glm::dvec3 chance = 1.0 - (apart - reach) / cell;  // on each axis, over all origins of the grid
    if (chance.x > 0 && chance.y > 0 && chance.z > 0)        // not where a coordinate is not finite
      meet += std::min(chance.x, 1.0) * std::min(chance.y, 1.0) * std::min(chance.z, 1.0);
  }
  return drawn_ > 0 ? meet / drawn_ : 0;
}

}  // namespace app::compare
