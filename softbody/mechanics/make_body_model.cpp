#include "softbody/mechanics/make_body_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/bound.h"
#include "softbody/mechanics/deformation.h"
#include "softbody/mechanics/visit.h"
#include "softbody/model/scene_error.h"

namespace softbody {
namespace {

/// One body by itself, in double precision.
class Relaxation {
 public:
  Relaxation(const BodyModel& model, const std::vector<glm::dvec3>& from)
      : model_(model), size_(from.size()), x_(3 * size_), v_(3 * size_), f_(3 * size_) {
    for (std::size_t i = 0; i < size_; ++i) write(x_, i, from[i]);
  }

  void evaluate() {
    std::ranges::fill(f_, 0.0);
    const LaneBodies<double> alone{model_, 1, field(x_), field(f_)};
    const Still still;
    visit_all(model_, alone.x, simd::AddForces<double, one_lane, Still>{alone, still});
  }

  double largest_force() const {
    double largest2 = 0;  // or NaN, once there is one
    for (std::size_t i = 0; i < size_; ++i) {
      const glm::dvec3 force = read(f_, i);
      const double force2 = glm::dot(force, force);
      if (force2 > largest2 || std::isnan(force2)) largest2 = force2;
    }
    return std::sqrt(largest2);
  }

  /// One step of h; velocities are dropped whenever the kinetic energy has passed a peak. From rest it takes half a
  /// kick, as leapfrog does: a whole one would overshoot by more than it started with where h is near the stable limit.
  void step(double h) {
    const double kick = (kinetic_ > 0 ? h : h / 2) / model_.particle_mass;
    double kinetic = 0;
    for (std::size_t i = 0; i < v_.size(); ++i) {
      v_[i] += kick * f_[i];
      kinetic += v_[i] * v_[i];
    }
    if (kinetic < kinetic_) {
      std::ranges::fill(v_, 0.0);
      kinetic = 0;
    }
    kinetic_ = kinetic;
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += h * v_[i];
  }

  std::vector<glm::dvec3> positions() const {
    std::vector<glm::dvec3> result;
    for (std::size_t i = 0; i < size_; ++i) result.push_back(read(x_, i));
    return result;
  }

 private:
  const BodyModel& model_;
  std::size_t size_;
  Lanes x_, v_, f_;  // of one lane
  double kinetic_ = 0;
};

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

std::vector<glm::dvec3> find_equilibrium(const BodyModel& model, const std::vector<glm::dvec3>& from) {
  assert(from.size() == model.mesh.vertices.size());
  Relaxation relaxation(model, from);
  const ModelForces& all = *model.forces;
  const double scale = (all.pair_stiffness + all.pressure * model.radius) * model.radius;
  // Half of what is stable: the kinetic energy has a peak to be found only where a swing takes more than a few steps.
  const double h = 0.5 * stable_step(stiffness_per_mass(model, measure_surface(model, model.mesh.vertices)), 0);
  constexpr int limit = 50'000;
  for (int i = 0; i < limit; ++i) {
    relaxation.evaluate();
    const double force = relaxation.largest_force();
    if (!std::isfinite(force)) break;
    if (force <= 1e-11 * scale) return relaxation.positions();
    relaxation.step(h);
  }
  throw SceneError("material '" + model.material.name + "': springs and gas pressure find no equilibrium; lower " +
                   "gas_pressure towards ambient_pressure, raise the stiffness, or set start_in_equilibrium = false");
}

std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& source, const Material& material) {
  auto model = make_body_mesh(source);
  give_material(*model, source, material);
  return model;
}

std::shared_ptr<const BodyModel> make_body_model(const MeshSource& mesh, const Material& material) {
  auto model = make_unbalanced_body_model(mesh, material);
  if (material[Material::start_in_equilibrium] == 0 || model->forces->pressure <= 0) return model;
  model->start = find_equilibrium(*model, model->mesh.vertices);
  model->start_volume = volume(model->start, model->mesh.triangles);
  model->start_energy = stored_energy(*model, model->start);
  return model;
}

std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material) {
  auto changed = std::make_shared<BodyModel>(model);
  give_material(*changed, source, material);
  return changed;
}

}  // namespace softbody
