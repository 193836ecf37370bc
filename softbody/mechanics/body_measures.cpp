#include "softbody/mechanics/body_measures.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/mechanics/kernels.h"
#include "softbody/state/state.h"

namespace softbody {
namespace {

BodyMeasures measures_of(const BodyModel& model, const MotionSums& sums, std::size_t lane, const glm::dvec3& origin,
                         const glm::dvec3& gravity) {
  const double mass = model.particle_mass;
  const glm::dvec3 place = sums.place[lane];
  BodyMeasures m;
  m.energy = {.kinetic = mass / 2 * sums.square[lane],
              .elastic = sums.elastic[lane],
              .gas = sums.gas[lane],
              .gravity = -mass * glm::dot(gravity, double(model.mesh.vertices.size()) * origin + place)};
  m.momentum = mass * sums.velocity[lane];
  m.power = glm::dot(gravity, m.momentum) - sums.growth[lane];
  m.closed = model.mesh.closed;
  if (m.closed) m.volume_ratio = sums.volume[lane] / model.start_volume;
  m.largest_strain = sums.strain[lane];
  m.max_speed = std::sqrt(sums.fastest2[lane]);
  m.finite = std::isfinite(sums.square[lane]) && std::isfinite(glm::dot(place, place));
  return m;
}

/// Measures the body in each lane of a batch, each of whose values is `stride` after the one before. wide: memory for
/// positions and velocities in double.
std::array<BodyMeasures, lanes> measure_batch(const State& state, const Batch& b, std::size_t stride,
                                              const glm::dvec3& gravity, LaneArray<double>& wide) {
  const std::size_t count = b.values();
  wide.resize(6 * count);
  double* to = wide.data();
  for (const VectorArray* array : {&state.x, &state.v})
    for (const auto& component : *array) {
      const float* from = component.data() + b.base;
      for (std::size_t i = 0; i < count; ++i) *to++ = double(from[i * stride]);
    }
  const auto vectors = [&](std::size_t k) -> Field<const double> {
    const double* first = wide.data() + 3 * k * count;
    return {first, first + count, first + 2 * count};
  };
  MotionSums sums{};
  force_kernels(b.width).measure_motion({*b.model, b.used, vectors(0), vectors(1)}, sums);
  std::array<BodyMeasures, lanes> measures;
  for (std::size_t l = 0; l < std::size_t(b.used); ++l)
    measures[l] = measures_of(*b.model, sums, l, state.body(b.body[l]).origin, gravity);
  return measures;
}

}  // namespace

Energy& Energy::operator+=(const Energy& other) {
  kinetic += other.kinetic;
  elastic += other.elastic;
  gas += other.gas;
  gravity += other.gravity;
  return *this;
}

BodyMeasures measure(const State& state, BodyId id, const glm::dvec3& gravity) {
  const Batch& b = state.batch_of(id);
  const Batch alone{.model = b.model, .width = one_lane, .base = state.slot(id, 0), .used = 1, .body = {id}};
  LaneArray<double> wide;
  return measure_batch(state, alone, std::size_t(b.width), gravity, wide)[0];
}

std::vector<BodyMeasures> measure_bodies(const State& state, const glm::dvec3& gravity) {
  std::vector<BodyMeasures> list(state.body_count());
  LaneArray<double> wide;  // stays in the cache
  for (const Batch& b : state.batches()) {
    const std::array<BodyMeasures, lanes> measures = measure_batch(state, b, 1, gravity, wide);
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) list[b.body[l]] = measures[l];
  }
  return list;
}

}  // namespace softbody
