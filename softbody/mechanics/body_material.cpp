#include "softbody/mechanics/body_material.h"

#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/bound.h"
#include "softbody/mechanics/deformation.h"

namespace softbody {
namespace {

/// Sets everything that depends on the material, except the starting shape.
void give_material(BodyModel& model, const MeshSource& source, const Material& material) {
  model.material = material;
  if (!material.given(Material::thickness)) model.material[Material::thickness] = 0.01 * model.radius;
  model.particle_mass = material[Material::mass] / double(model.mesh.vertices.size());
  auto forces = std::make_shared<ModelForces>();
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (requires { F::adapt(model.material, model.mesh); }) F::adapt(model.material, model.mesh);
    if constexpr (HasElements<F>) forces->of<F>() = F::make(model, source);
  });
  set_bounds(*forces, model.mesh.vertices.size());
  model.forces = forces;
  model.start_energy = stored_energy(model, model.start);
}

}  // namespace

std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& source, const Material& material) {
  auto p = make_body_mesh(source);
  give_material(*p, source, material);
  return p;
}

std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material) {
  auto p = std::make_shared<BodyModel>(model);
  give_material(*p, source, material);
  return p;
}

}  // namespace softbody
