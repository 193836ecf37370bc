#include "softbody/forces/gas.h"

#include <cmath>

#include "softbody/forces/model_forces.h"

namespace softbody {

double Gas::ambient_energy(double v) const {
  const double bend = linear_end();
  const double pushed_away = std::abs(v) < bend ? (v * v + bend * bend) / (2 * bend) : std::abs(v);
  return ambient * (pushed_away - rest_volume);
}

double Gas::stored(double v) const {
  const double bend = linear_end();
  if (v >= bend) return ambient_energy(v) - amount * std::log(v / rest_volume);
  const double beyond = bend - v;  // the integral of the linear law from v to the bend
  return ambient_energy(v) - amount * std::log(0.1) + amount / bend * (beyond + beyond * beyond / (2 * bend));
}

double Gas::stored_change(double from, double to) const {
  const double by_gas = (to - from) / 6 * (pressure(from) + 4 * pressure((from + to) / 2) + pressure(to));
  return ambient_energy(to) - ambient_energy(from) - by_gas;
}

std::optional<Gas> GasPressure::make(const BodyModel& model, const MeshSource&) {
  const double in = model.material[inside], out = model.material[outside];
  if (!model.mesh.closed || (in <= 0 && out <= 0)) return {};
  const double volume = softbody::volume(model.mesh.vertices, model.mesh.triangles);
  return Gas{.amount = in * volume, .ambient = out, .rest_volume = volume};
}

const Gas* gas_of(const BodyModel& model) { return data<GasPressure>(model); }

}  // namespace softbody
