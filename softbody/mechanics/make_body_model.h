#pragma once
// Makes body models of meshes and materials, and finds the shape in which springs and gas pressure are in balance.

#include "softbody/model/body_model.h"

namespace softbody {

/// Brings the vertices `from` into balance by dynamic relaxation with kinetic damping, in double precision, and returns
/// the positions. Uses the springs and the gas of the body model, which must be filled in, and no other force. Throws
/// SceneError that names the material if the body does not come to rest.
std::vector<glm::dvec3> find_equilibrium(const BodyModel& model, const std::vector<glm::dvec3>& from);

/// Returns a body model that starts in equilibrium if its material says so. Throws SceneError if no equilibrium is
/// found.
std::shared_ptr<const BodyModel> make_body_model(const MeshSource& mesh, const Material& material);

/// Returns a body model whose starting shape is the mesh itself, whether or not that is in equilibrium.
std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& mesh, const Material& material);

/// Returns a body model of the same mesh with another material. It keeps the starting shape, which is in equilibrium
/// only for the material that it was found for. `source`: the source of the model's mesh.
std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material);

}  // namespace softbody
