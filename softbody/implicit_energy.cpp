#include "softbody/implicit_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace softbody {
namespace {

/// One lane of a field.
struct LaneView {
  const Lanes& field;
  std::size_t lane, stride;
  glm::dvec3 operator[](std::size_t i) const {
    const std::size_t at = i * lanes + lane;
    return {field[at], field[at + stride], field[at + 2 * stride]};
  }
};

double spring_energy(const Prototype& p, const LaneView& x) {
  double energy = 0;
  for (const auto* list : {&p.structural, &p.bend, &p.shear})
    for (const Spring& s : *list) {
      const double longer = glm::distance(x[s.i], x[s.j]) - s.rest;
      energy += s.stiffness / 2 * longer * longer;
    }
  return energy;
}

double kinetic_energy(const Prototype& p, const LaneView& v) {
  double square = 0;
  for (std::size_t i = 0; i < p.mesh.vertices.size(); ++i) square += glm::dot(v[i], v[i]);
  return p.particle_mass / 2 * square;
}

double volume_of(const Prototype& p, const LaneView& x) {
  double six = 0;
  const glm::dvec3 from = x[0];
  for (const auto& [a, b, c] : p.mesh.triangles) six += glm::dot(x[a] - from, glm::cross(x[b] - from, x[c] - from));
  return six / 6;
}

/// J that the gas loses. By Simpson's rule: a logarithm has not the same last digits on all processors.
double gas_work(const Prototype& p, double from, double to) {
  const auto gauge = [&p](double volume) { return p.gas.pressure(volume) - p.gas.ambient; };
  return (to - from) / 6 * (gauge(from) + 4 * gauge((from + to) / 2) + gauge(to));
}

}  // namespace

double contact_work(const ImplicitWork& work, std::size_t lane) {
  const std::size_t stride = work.x.size() / 3;
  const LaneView x{work.x, lane, stride}, end_x{work.end_x, lane, stride};
  double sum = 0;
  for (const PlaneContact& c : work.planes)  // they push out, and friction takes
    if (c.at % lanes == lane) sum += glm::dot(c.force, c.normal) * std::max(0.0, c.need);
  for (const LinearShield& s : work.shields) {
    if (s.at % lanes != lane) continue;
    const glm::dvec3 moved = end_x[s.at / lanes] - x[s.at / lanes];
    sum += std::max(0.0, glm::dot(s.after(moved), moved));
  }
  return sum;
}

double undue_energy(const Prototype& p, const ImplicitWork& work, std::size_t lane, const glm::dvec3& gravity,
                    double contact_work) {
  constexpr double share = 5e-5, rounding = 1e-12;  // of the motion's energy, and of the springs'
  if (!p.goal.empty()) return 0;
  const std::size_t n = p.mesh.vertices.size(), stride = n * lanes;
  const LaneView x{work.x, lane, stride}, end_x{work.end_x, lane, stride};
  double fallen = 0;
  for (std::size_t i = 0; i < n; ++i) fallen += p.particle_mass * glm::dot(gravity, end_x[i] - x[i]);
  const double before = kinetic_energy(p, {work.v, lane, stride}),
               after = kinetic_energy(p, {work.end_v, lane, stride});
  const double elastic = spring_energy(p, x);
  double gain = after - before - fallen - contact_work + spring_energy(p, end_x) - elastic;
  if (p.has_gas) gain -= gas_work(p, volume_of(p, x), volume_of(p, end_x));
  return std::isfinite(gain) ? std::max(0.0, gain - share * (before + after) - rounding * elastic)
                             : std::numeric_limits<double>::infinity();
}

bool take_back(const Prototype& p, ImplicitWork& work, std::size_t lane, double energy) {
  constexpr double most = 0.05;  // of the energy of motion
  const std::size_t stride = p.mesh.vertices.size() * lanes;
  const double kinetic = kinetic_energy(p, {work.end_v, lane, stride});
  if (!(energy <= most * kinetic)) return false;
  const double slower = kinetic > 0 ? std::sqrt(1 - energy / kinetic) : 1;
  for (std::size_t i = lane; i < 3 * stride; i += lanes) work.end_v[i] *= slower;
  return true;
}

}  // namespace softbody
