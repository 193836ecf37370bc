#include "app/reference/reference_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "app/reference/body_shape.h"
#include "softbody/contact/solid_surface.h"
#include "softbody/forces/gas.h"
#include "softbody/mechanics/bound.h"

namespace app::reference {
namespace {

using glm::dvec3;
using softbody::Stage;

constexpr double tangent_below = 0.1;  // of V0: below this volume the law of the ideal gas continues as its tangent

double absolute_pressure(const softbody::Gas& gas, double volume) {
  const double knee = tangent_below * gas.rest_volume;
  if (volume > knee) return gas.amount / volume;
  return gas.amount / knee + gas.amount / (knee * knee) * (knee - volume);
}

/// Returns the ambient pressure. It stays on the outer side of a body that is inside out: its sign changes linearly
/// between the volumes -tangent_below V0 and +tangent_below V0.
double ambient_pressure(const softbody::Gas& gas, double volume) {
  const double knee = tangent_below * gas.rest_volume;
  if (volume > knee) return gas.ambient;
  return volume < -knee ? -gas.ambient : gas.ambient * (volume / knee);
}

/// Returns the integral of the ambient pressure minus the absolute pressure, from V0 on.
double gas_energy(const softbody::Gas& gas, double volume) {
  const double knee = tangent_below * gas.rest_volume, low = std::min(volume, knee);
  const double ideal = -gas.amount * std::log(std::max(volume, knee) / gas.rest_volume);
  const double tangent = (knee - low) * (gas.amount / knee + absolute_pressure(gas, low)) / 2;
  const double flat = std::clamp(volume, -knee, knee);  // between these the ambient part is a parabola
  const double ambient = gas.ambient * (std::max(volume, knee) - gas.rest_volume + std::max(0.0, -knee - volume)) +
                         gas.ambient * (flat * flat - knee * knee) / (2 * knee);
  return ambient + ideal + tangent;
}

/// Returns a + s b for all particles.
std::vector<dvec3> add_scaled(const std::vector<dvec3>& a, double s, const std::vector<dvec3>& b) {
  std::vector<dvec3> sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = a[i] + s * b[i];
  return sum;
}

}  // namespace

BodyState state_of(const softbody::World& world, softbody::BodyId body) {
  BodyState state;
  for (softbody::Index i = 0; i < world.model(body).mesh.vertices.size(); ++i) {
    const softbody::Particle p = world.particle(body, i);
    state.x.push_back(p.position);
    state.v.push_back(p.velocity);
  }
  return state;
}

std::string ReferenceBody::unsupported_stage(const softbody::World& world) {
  // Detection and sleep move nothing: a body that sleeps has come to rest.
  constexpr std::array<std::string_view, 9> known{
      "structural-springs", "bend-springs", "shear-springs", "gas-pressure", "gravity",
      "integrate",          "solids",       "detect",        "sleep"};
  if (world.scene().bodies.size() != 1) return "several bodies";
  for (const Stage stage : world.plan().stages)
    if (std::ranges::find(known, softbody::stage_key(stage)) == known.end())
      return std::string(softbody::stage_key(stage));
  return {};
}

std::vector<dvec3> ReferenceBody::accelerations(const BodyState& state) const {
  std::vector<dvec3> a(state.x.size(), scene_.gravity);
  softbody::for_each_spring(model_, [&](const softbody::Spring& s) {
    const dvec3 d = state.x[s.j] - state.x[s.i];
    const double length = glm::length(d);
    if (length == 0) return;  // no direction
    const dvec3 n = d / length;
    const double tension = s.stiffness * (length - s.rest) + s.damping * glm::dot(state.v[s.j] - state.v[s.i], n);
    a[s.i] += tension / model_.particle_mass * n;
    a[s.j] -= tension / model_.particle_mass * n;
  });
  const softbody::Gas* gas = softbody::gas_of(model_);
  if (!gas) return a;
  const double volume = volume_of(state.x, model_.mesh.triangles);
  const double gauge = absolute_pressure(*gas, volume) - ambient_pressure(*gas, volume);
  for (const auto& [i, j, k] : model_.mesh.triangles) {
    const dvec3 area = 0.5 * glm::cross(state.x[j] - state.x[i], state.x[k] - state.x[i]);
    for (const softbody::Index corner : {i, j, k}) a[corner] += gauge / 3 / model_.particle_mass * area;
  }
  return a;
}

/// Corrects the velocities for the coming h seconds: no particle gets below a surface, and one that is below rises with
/// at most 1 m/s and a tenth of its depth per step. Coulomb friction acts in proportion to the correction.
void ReferenceBody::collide_with_solids(const std::vector<dvec3>& x, std::vector<dvec3>& v, double h) const {
  const double thickness = model_.material[softbody::Material::thickness];
  for (const softbody::Solid& solid : scene_.solids) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const softbody::SolidSurface s = softbody::surface_at(solid, x[i]);
      const double gap = s.distance - thickness;
      const double min_up = gap > 0 ? -gap / h : std::min(-0.1 * gap / h, 1.0);
      const double up = glm::dot(v[i], s.normal);
      if (up >= min_up) continue;
      const dvec3 along = v[i] - up * s.normal;
      const double slip = glm::length(along), lost = std::min(slip, solid.friction * (min_up - up));
      v[i] = min_up * s.normal + (slip > 0 ? (1 - lost / slip) * along : along);
    }
  }
}

void ReferenceBody::step(BodyState& state, double h) const {
  const std::vector<dvec3> a1 = accelerations(state);
  const BodyState s2{add_scaled(state.x, h / 2, state.v), add_scaled(state.v, h / 2, a1)};
  const std::vector<dvec3> a2 = accelerations(s2);
  const BodyState s3{add_scaled(state.x, h / 2, s2.v), add_scaled(state.v, h / 2, a2)};
  const std::vector<dvec3> a3 = accelerations(s3);
  const BodyState s4{add_scaled(state.x, h, s3.v), add_scaled(state.v, h, a3)};
  const std::vector<dvec3> a4 = accelerations(s4);
  std::vector<dvec3> mean(state.x.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (state.v[i] + 2.0 * s2.v[i] + 2.0 * s3.v[i] + s4.v[i]) / 6.0;
  const std::vector<dvec3> free = mean;
  collide_with_solids(state.x, mean, h);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    state.x[i] += h * mean[i];
    state.v[i] += h / 6 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]) + (mean[i] - free[i]);
  }
  collide_with_solids(state.x, state.v, h);
}

double ReferenceBody::stable_step(const BodyState& state) const {
  const double k_m = softbody::stiffness_per_mass(model_, softbody::measure_surface(model_, state.x));
  const double c_m = softbody::damping_bound(model_) / model_.particle_mass;
  return softbody::find_integrator("rk4")->stable_step(k_m, c_m);
}

double ReferenceBody::energy(const BodyState& state) const {
  double energy = 0;
  for (std::size_t i = 0; i < state.x.size(); ++i)
    energy += model_.particle_mass * (0.5 * glm::dot(state.v[i], state.v[i]) - glm::dot(scene_.gravity, state.x[i]));
  softbody::for_each_spring(model_, [&](const softbody::Spring& s) {
    const double stretch = glm::distance(state.x[s.i], state.x[s.j]) - s.rest;
    energy += 0.5 * s.stiffness * stretch * stretch;
  });
  if (const auto* gas = softbody::gas_of(model_)) energy += gas_energy(*gas, volume_of(state.x, model_.mesh.triangles));
  return energy;
}

}  // namespace app::reference
