#pragma once
// The shape in which springs and gas pressure are in balance.

#include "softbody/model/body_model.h"

namespace softbody {

/// Brings the vertices `from` into balance by dynamic relaxation with kinetic damping, in double precision, and returns
/// the positions. Uses the springs and the gas of the body model, which must be filled in, and no other force. Throws
/// SceneError that names the material if the body does not come to rest.
std::vector<glm::dvec3> find_equilibrium(const BodyModel& model, const std::vector<glm::dvec3>& from);

/// Returns a body model that starts in equilibrium if its material says so. Throws SceneError if no equilibrium is
/// found.
std::shared_ptr<const BodyModel> make_body_model(const MeshSource& mesh, const Material& material);

}  // namespace softbody
