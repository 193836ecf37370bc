#include "softbody/mechanics/body_material.h"

#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/bound.h"
#include "softbody/mechanics/deformation.h"

namespace softbody {
namespace {

/// Sets everything that depends on the material, except the starting shape.
void give_material(BodyModel& p, const MeshSource& source, const Material& material) {
  p.material = material;
  if (!material.given(Material::thickness)) p.material[Material::thickness] = 0.01 * p.radius;
  p.particle_mass = material[Material::mass] / double(p.mesh.vertices.size());
  auto forces = std::make_shared<ModelForces>();
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (requires { F::adapt(p.material, p.mesh); }) F::adapt(p.material, p.mesh);
    if constexpr (HasElements<F>) forces->of<F>() = F::make(p, source);
  });
  set_bounds(*forces, p.mesh.vertices.size());
  p.forces = forces;
  p.start_energy = stored_energy(p, p.start);
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
