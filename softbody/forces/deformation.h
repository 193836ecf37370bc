#pragma once
// What a body's deformation holds, with its particles at x: one place a particle, in m.

#include <vector>

#include "softbody/model/body_model.h"

namespace softbody {

/// In J: of springs, and of what keeps the shape.
double elastic_energy(const BodyModel& model, const std::vector<glm::dvec3>& x);

/// In m^3, of a closed mesh; the particles may be far from the origin.
double enclosed_volume(const BodyModel& model, const std::vector<glm::dvec3>& x);

}  // namespace softbody
