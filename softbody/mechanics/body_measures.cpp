#include "softbody/mechanics/body_measures.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/mechanics/kernels.h"
#include "softbody/state/state.h"

namespace softbody {
namespace {

/// Positions and velocities of bodies in double.
class WideMotion {
 public:
  /// Takes `count` values of each component from `first` on, of which each is `stride` after the one before.
  void take(const State& state, std::size_t first, std::size_t stride, std::size_t count) {
    size_ = count;
    values_.resize(6 * count);
    double* to = values_.data();
    for (const VectorArray* array : {&state.x, &state.v})
      for (const auto& component : *array) {
        const float* from = component.data() + first;
        if (stride == 1)
          std::copy_n(from, count, to);
        else
          for (std::size_t i = 0; i < count; ++i) to[i] = double(from[i * stride]);
        to += count;
      }
  }
  MovingBodies bodies(const BodyModel& model, int used) const {
    const auto field = [this](std::size_t k) -> Field<const double> {
      const double* first = values_.data() + 3 * k * size_;
      return {first, first + size_, first + 2 * size_};
    };
    return {model, used, field(0), field(1)};
  }

 private:
  std::size_t size_ = 0;
  LaneArray<double> values_;
};

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
  WideMotion motion;
  motion.take(state, state.slot(id, 0), std::size_t(b.width), b.particles());
  MotionSums sums{};
  force_kernels(one_lane).measure_motion(motion.bodies(*b.model, 1), sums);
  return measures_of(*b.model, sums, 0, state.body(id).origin, gravity);
}

std::vector<BodyMeasures> measure_bodies(const State& state, const glm::dvec3& gravity) {
  std::vector<BodyMeasures> list(state.body_count());
  WideMotion motion;  // its memory stays in the cache
  for (const Batch& b : state.batches()) {
    motion.take(state, b.base, 1, b.values());
    MotionSums sums{};
    force_kernels(b.width).measure_motion(motion.bodies(*b.model, b.used), sums);
    for (std::size_t l = 0; l < std::size_t(b.used); ++l)
      list[b.body[l]] = measures_of(*b.model, sums, l, state.body(b.body[l]).origin, gravity);
  }
  return list;
}

}  // namespace softbody
