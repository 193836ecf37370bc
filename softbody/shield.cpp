#include "softbody/shield.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

namespace softbody {
namespace {

glm::vec3 read(Field<const float> f, std::size_t slot) { return {f.x[slot], f.y[slot], f.z[slot]}; }

}  // namespace

void Shield::evaluate(collide::Part part, Field<const float> x, Field<const float> v) {
  const float h = thickness;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const ShieldPair& p = pairs[i];
    force[i] = glm::vec3(0.0f);
    const glm::vec3 d = read(x, p.slot_a) - read(x, p.slot_b) + p.offset;
    const float s = glm::dot(d, p.normal);
    const float beyond = std::min(s, 0.0f);
    const float weight = 1 - (glm::dot(d, d) - beyond * beyond) / (h * h);
    if (weight <= 0) continue;
    const glm::vec3 velocity = read(v, p.slot_a) - read(v, p.slot_b);
    const float separating = glm::dot(velocity, p.normal);
    const float damping = std::clamp(1 - separating / rebound_speed, 0.0f, approach_limit);
    const float push = p.stiffness * weight * std::min(h - s, h) * damping;
    const glm::vec3 slip = velocity - separating * p.normal;
    const float speed = glm::length(slip);
    const float viscous = 0.5f * p.stiffness * h / rebound_speed * weight;
    const float drag = std::min(p.friction * push / std::max(speed, std::numeric_limits<float>::min()), viscous);
    force[i] = push * p.normal - drag * slip;
  }
}

}  // namespace softbody
