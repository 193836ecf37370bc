#include <algorithm>

#include "softbody/forces/kernels.h"
#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

/// Of XPBD the limit of one constraint on the volume V with the gas as its compliance: along the gradient g of V the
/// gauge pressure p acts that the step ends with, to first order: p = gauge(V) / (1 - slope(V) h^2 |g|^2 / m).
void Dynamics::project_gas(Batch& b, Quantity d, float h) {
  const BodyModel& p = *b.model;
  if (!p.has_gas) return;
  float volume[lanes], unit[lanes];
  double square[lanes]{};
  std::fill_n(unit, lanes, 1.0f);
  clear(b, forces);
  force_kernels(b.width).volume(b.used, b.mesh->faces, at(x_, b), volume);
  force_kernels(b.width).pressure(b.used, b.mesh->faces, at(x_, b), unit, at(f_, b));
  const auto width = std::size_t(b.width), used = std::size_t(b.used);
  for (const auto& gradient : f_)
    for (std::size_t at = b.base; at < b.base + b.values(); at += width)
      for (std::size_t l = 0; l < used; ++l) square[l] += double(gradient[at + l]) * double(gradient[at + l]);
  const double h2_m = double(h) * double(h) / p.particle_mass;
  float shift[lanes];
  for (std::size_t l = 0; l < used; ++l) {
    const double gauge = p.gas.gauge(double(volume[l]));
    shift[l] = b.moves[l] * float(h2_m * gauge / (1 - p.gas.slope(double(volume[l])) * h2_m * square[l]));
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t at = b.base; at < b.base + b.values(); at += width)
      for (std::size_t l = 0; l < used; ++l) components(d)[k][at + l] += shift[l] * f_[k][at + l];
}

void Dynamics::project_springs(Batch& b, Quantity x0, Quantity d, float h) {
  const ProjectArguments arguments{h, float(1 / b.model->particle_mass), b.moves.data()};
  for (const KernelSprings* list : {&b.mesh->structural, &b.mesh->bend, &b.mesh->shear})
    force_kernels(b.width).project_springs(b.used, arguments, *list, at(std::as_const(components(x0)), b),
                                           at(components(d), b));
}

void xpbd(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  constexpr Quantity start = scratch(0), displacements = velocities;
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.other_forces(*batch);
    dynamics.kick(*batch, substep.h);
    dynamics.copy(*batch, positions, start);
    dynamics.drift(*batch, substep.h);
    dynamics.scale(*batch, velocities, substep.h);
    dynamics.project_gas(*batch, displacements, substep.h);
    dynamics.project_springs(*batch, start, displacements, substep.h);
    dynamics.scale(*batch, displacements, 1 / substep.h);
    dynamics.copy(*batch, start, positions);  // hand and contacts see where the velocities lead to from here
    dynamics.pull(*batch, substep.h);
  }
  dynamics.contacts(worker, substep.h);
  for (Batch* batch : worker.batches()) dynamics.drift(*batch, substep.h);
  worker.barrier();
}

}  // namespace softbody
