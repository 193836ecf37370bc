#include "softbody/mechanics/deformation.h"

#include <glm/geometric.hpp>

#include "softbody/mechanics/visit.h"

namespace softbody {
namespace {

using Shape = std::vector<glm::dvec3>;

/// The energy of elements whose coordinate is not the volume.
struct SumElastic {
  const Shape& x;
  double& sum;
  void operator()(Length c, const auto& law) const { sum += stored_at(law, glm::distance(x[c.i], x[c.j])); }
  void operator()(Offset c, const simd::Vec<double>& place, const auto& law) const {
    const glm::dvec3 away = x[c.i] - glm::dvec3(place.x, place.y, place.z);
    sum += law.stiffness / 2 * glm::dot(away, away);
  }
};

}  // namespace

double elastic_energy(const BodyModel& model, const Shape& x) {
  std::array<std::vector<double>, 3> component;
  for (int k = 0; k < 3; ++k)
    for (const glm::dvec3& place : x) component[std::size_t(k)].push_back(place[k]);
  double sum = 0;
  visit_forces<Coordinate::length, Coordinate::offset>(
      model, {component[0].data(), component[1].data(), component[2].data()}, SumElastic{x, sum});
  return sum;
}

StoredEnergy stored_energy(const BodyModel& model, const Shape& x) {
  StoredEnergy energy{.elastic = elastic_energy(model, x)};
  if (model.forces->pressure <= 0) return energy;
  visit_forces<Coordinate::volume>(
      model, {}, [&, v = enclosed_volume(model, x)](Volume, const auto& law) { energy.gas += law.stored(v); });
  return energy;
}

StoredEnergy stored_energy_change(const BodyModel& model, const Shape& from, const Shape& to) {
  StoredEnergy change{.elastic = elastic_energy(model, to) - elastic_energy(model, from)};
  if (model.forces->pressure <= 0) return change;
  const double before = enclosed_volume(model, from), after = enclosed_volume(model, to);
  visit_forces<Coordinate::volume>(model, {},
                                   [&](Volume, const auto& law) { change.gas += law.stored_change(before, after); });
  return change;
}

double enclosed_volume(const BodyModel& model, const Shape& x) {
  const glm::dvec3 from = x.front();  // any point will do; a near one loses no digits
  double six = 0;
  for (const auto& [a, b, c] : model.mesh.triangles) six += glm::dot(x[a] - from, glm::cross(x[b] - from, x[c] - from));
  return six / 6;
}

}  // namespace softbody
