#include "softbody/mechanics/make_body_model.h"

#include <algorithm>
#include <cmath>

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
  Relaxation(const BodyModel& model, const std::vector<glm::dvec3>& from) : model_(model), size_(from.size()) {
    for (auto* field : {&x_, &v_, &f_})
      for (auto& component : *field) component.assign(size_, 0.0);
    for (std::size_t i = 0; i < from.size(); ++i)
      for (int k = 0; k < 3; ++k) x_[k][i] = from[i][k];
  }

  void evaluate() {
    for (auto& component : f_) std::fill(component.begin(), component.end(), 0.0);
    const LaneBodies<double> alone{model_, 1, field(x_), field(f_)};
    const Still still;
    visit_all(model_, alone.x, simd::AddForces<double, one_lane, Still>{alone, still});
  }

  double largest_force() const {
    double largest2 = 0;  // or NaN, once there is one
    for (std::size_t i = 0; i < size_; ++i) {
      const double force2 = f_[0][i] * f_[0][i] + f_[1][i] * f_[1][i] + f_[2][i] * f_[2][i];
      if (force2 > largest2 || std::isnan(force2)) largest2 = force2;
    }
    return std::sqrt(largest2);
  }

  /// One step of h; velocities are dropped whenever the kinetic energy has passed a peak. From rest it takes half a
  /// kick, as leapfrog does: a whole one would overshoot by more than it started with where h is near the stable limit.
  void step(double h) {
    const double kick = (kinetic_ > 0 ? h : h / 2) / model_.particle_mass;
    double kinetic = 0;
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < size_; ++i) {
        v_[k][i] += kick * f_[k][i];
        kinetic += v_[k][i] * v_[k][i];
      }
    if (kinetic < kinetic_) {
      for (auto& component : v_) std::fill(component.begin(), component.end(), 0.0);
      kinetic = 0;
    }
    kinetic_ = kinetic;
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < size_; ++i) x_[k][i] += h * v_[k][i];
  }

  std::vector<glm::dvec3> positions() const {
    std::vector<glm::dvec3> result;
    for (std::size_t i = 0; i < size_; ++i) result.emplace_back(x_[0][i], x_[1][i], x_[2][i]);
    return result;
  }

 private:
  using Components = std::array<LaneArray<double>, 3>;
  static Field<double> field(Components& c) { return {c[0].data(), c[1].data(), c[2].data()}; }

  const BodyModel& model_;
  std::size_t size_;
  Components x_, v_, f_;
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
  auto p = make_body_mesh(source);
  give_material(*p, source, material);
  return p;
}

std::shared_ptr<const BodyModel> make_body_model(const MeshSource& mesh, const Material& material) {
  auto p = make_unbalanced_body_model(mesh, material);
  if (material[Material::start_in_equilibrium] == 0 || p->forces->pressure <= 0) return p;
  p->start = find_equilibrium(*p, p->mesh.vertices);
  p->start_volume = volume(p->start, p->mesh.triangles);
  p->start_energy = stored_energy(*p, p->start);
  return p;
}

std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material) {
  auto p = std::make_shared<BodyModel>(model);
  give_material(*p, source, material);
  return p;
}

}  // namespace softbody
