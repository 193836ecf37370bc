#include "softbody/forces/deformation.h"

#include <glm/geometric.hpp>

#include "softbody/forces/shape_matching.h"

namespace softbody {

double elastic_energy(const BodyModel& p, const std::vector<glm::dvec3>& x) {
  double energy = shape_energy(p, x);
  for (const auto* springs : {&p.structural, &p.bend, &p.shear})
    for (const Spring& s : *springs) {
      const double stretch = glm::distance(x[s.i], x[s.j]) - s.rest;
      energy += 0.5 * s.stiffness * stretch * stretch;
    }
  return energy;
}

double enclosed_volume(const BodyModel& p, const std::vector<glm::dvec3>& x) {
  const glm::dvec3 from = x.front();  // any point will do; a near one loses no digits
  double six = 0;
  for (const auto& [a, b, c] : p.mesh.triangles) six += glm::dot(x[a] - from, glm::cross(x[b] - from, x[c] - from));
  return six / 6;
}

}  // namespace softbody
