#pragma once
// Energy and volume of a deformed body. x: the positions of its particles in m.

#include <vector>

#include "softbody/model/body_model.h"

namespace softbody {

/// Returns the energy of springs and shape matching in J.
double elastic_energy(const BodyModel& model, const std::vector<glm::dvec3>& x);

/// Returns the volume of a closed mesh in m^3. The particles may be far from the origin.
double enclosed_volume(const BodyModel& model, const std::vector<glm::dvec3>& x);

}  // namespace softbody
