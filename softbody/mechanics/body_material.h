#pragma once
// Body models and their material.

#include "softbody/model/body_model.h"

namespace softbody {

/// Returns a body model whose starting shape is the mesh itself, whether or not that is in equilibrium.
std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& mesh, const Material& material);

/// Returns a body model of the same mesh with another material. It keeps the starting shape, which is in equilibrium
/// only for the material that it was found for. `source`: the source of the model's mesh.
std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material);

}  // namespace softbody
