#include "softbody/integrate/implicit/problem.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"

namespace softbody {

glm::dvec3 LinearPenaltyPair::force_after(const glm::dvec3& moved) const {
  const glm::dvec3 apart = moved - partner, faster = apart - start_separation;
  const double push = glm::dot(force, normal);
  const double press = std::max(
      0.0, push - double(slopes.spring) * glm::dot(apart, normal) - double(slopes.damper) * glm::dot(faster, normal));
  const auto across = [this](const glm::dvec3& v) { return v - glm::dot(v, normal) * normal; };
  // The friction spring of the start has slipped for this step already, see PenaltyContact::evaluate().
  const glm::dvec3 drag = across(force) - double(slopes.across_spring + slopes.across_damper) * across(faster);
  return press * normal + law::within_cone(drag, friction * press);
}

}  // namespace softbody
