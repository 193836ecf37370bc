#include "softbody/mechanics/force_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace softbody {
namespace {

LaneBodies<float> lanes_of(const ForceBatch& b) {
  return {*b.batch.model, b.batch.used, field(std::as_const(b.state).x, b.batch.base), b.f};
}

}  // namespace

/// takes(Name<F>{}): whether a force of the plan is added.
template <class Takes>
void ForceSet::add_if(const ForceBatch& b, Takes takes) {
  const ForceKernels& kernels = force_kernels(b.batch.width);
  const LaneBodies<float> bodies = lanes_of(b);
  const Moving motion{field(b.state.v, b.batch.base)};
  for_each_force(Forces{}, [&]<class F>(Name<F> name) {
    if (!taken_[index_of<F>] || !takes(name)) return;
    if constexpr (HasElements<F>)
      kernels.add[index_of<F>](bodies, motion);
    else
      std::get<F&>(objects_).add(b);
  });
}

void ForceSet::add(const ForceBatch& b) {
  add_if(b, [](auto) { return true; });
}

void ForceSet::add_unprojected(const ForceBatch& b) {
  add_if(b, []<class F>(Name<F>) { return is_unprojected<F>(); });
}

void ForceSet::advance(const ForceBatch& b, const Advance& how, LaneVolumes& volumes) {
  add_if(b, []<class F>(Name<F>) {
    return coordinate_of<F>() != Coordinate::length && coordinate_of<F>() != Coordinate::volume && !Kicks<F>;
  });
  force_kernels(b.batch.width).advance(lanes_of(b), b.kick_arguments(), how, field(b.state.v, b.batch.base), volumes);
  kick(b);
}

void ForceSet::press_again(const ForceBatch& b, LaneVolumes& volumes) const {
  if (b.batch.model->forces->pressure <= 0) return;
  force_kernels(b.batch.width).press_again(lanes_of(b), b.kick_arguments(), field(b.state.v, b.batch.base), volumes);
}

void ForceSet::project(const ForceBatch& b, Field<const float> x0, Field<float> d) const {
  const ForceKernels& kernels = force_kernels(b.batch.width);
  const LaneBodies<float> bodies = lanes_of(b);
  const Projection projection{float(b.h), b.batch.moves.data(), x0, d, bodies.f, b.state.held.free(b.batch)};
  for (const bool volumes : {true, false})
    for_each_force(Forces{}, [&]<class F>(Name<F>) {
      if constexpr (is_projected<F>())
        if (taken_[index_of<F>] && volumes == (F::coordinate == Coordinate::volume))
          kernels.project[index_of<F>](bodies, projection);
    });
}

void ForceSet::kick(const ForceBatch& b) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (Kicks<F>)
      if (taken_[index_of<F>]) std::get<F&>(objects_).kick(b);
  });
}

ForceBound bound_of(const Batch& b, Field<const float> x, bool projects) {
  const BodyModel& model = *b.model;
  if (projects) {
    const double unprojected = model.forces->offset_stiffness / model.particle_mass;
    return {unprojected, unprojected};
  }
  const double springs = stiffness_per_mass(model, {});
  ForceBound bound{springs, springs, damping_bound(model) / model.particle_mass};
  if (model.forces->pressure <= 0) return bound;
  VectorArray area;
  for (auto& component : area) component.resize(b.values());
  SurfaceShape shapes[lanes];
  force_kernels(b.width).measure_surfaces({model, b.used, x, field(area)}, shapes);
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    if (b.moves[l] <= 0) continue;
    bound.stiffness = std::max(bound.stiffness, stiffness_per_mass(model, shapes[l]));
    bound.implicit_volume = std::max(bound.implicit_volume, stiffness_per_mass(model, shapes[l], Volumes::implicit_));
    bound.volume_change = std::max(bound.volume_change, std::abs(shapes[l].volume / model.start_volume - 1));
  }
  return bound;
}

glm::dvec3 uniform_acceleration(const BodyModel& model, const glm::dvec3& gravity, const glm::dvec3& wind) {
  const auto* air = data<AirDrag>(model);
  return air ? gravity + air->damping / model.particle_mass * wind : gravity;
}

bool has_external_force(const BodyModel& model) {
  bool any = false;
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (HasElements<F>) any = any || (!F::internal && data<F>(model));
  });
  return any;
}

}  // namespace softbody
