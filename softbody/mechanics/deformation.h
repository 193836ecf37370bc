#pragma once
// Energy and volume of a deformed body. x: the positions of its particles in m.

#include <vector>

#include "softbody/model/body_model.h"

namespace softbody {

StoredEnergy stored_energy(const BodyModel& model, const std::vector<glm::dvec3>& x);

double elastic_energy(const BodyModel& model, const std::vector<glm::dvec3>& x);

/// Returns how the energy changes in J, without a logarithm, whose last digits differ between processors.
StoredEnergy stored_energy_change(const BodyModel& model, const std::vector<glm::dvec3>& from,
                                  const std::vector<glm::dvec3>& to);

/// Returns the volume of a closed mesh in m^3. The particles may be far from the origin.
double enclosed_volume(const BodyModel& model, const std::vector<glm::dvec3>& x);

}  // namespace softbody
