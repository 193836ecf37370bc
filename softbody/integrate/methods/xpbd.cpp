#include <algorithm>

#include "softbody/forces/kernels.h"
#include "softbody/integrate/motion.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

/// XPBD in the limit of one constraint on the volume V with the gas as its compliance: along the gradient g of V acts the
/// gauge pressure p with which the step ends, to first order p = gauge(V) / (1 - slope(V) h^2 |g|^2 / m).
void Motion::project_gas(const Batch& b, Quantity d, float h) {
  const BodyModel& p = *b.model;
  if (!p.has_gas) return;
  float volume[lanes], unit[lanes];
  double square[lanes]{};
  std::fill_n(unit, lanes, 1.0f);
  clear(b, forces);
  const std::vector<KernelTriangle>& faces = parts_.meshes(b).faces;
  force_kernels(b.width).volume(b.used, faces, x(b), volume);
  force_kernels(b.width).pressure(b.used, faces, x(b), unit, f(b));
  const auto width = std::size_t(b.width), used = std::size_t(b.used);
  for (const auto& gradient : parts_.state.f)
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
      for (std::size_t l = 0; l < used; ++l) array(d)[k][at + l] += shift[l] * parts_.state.f[k][at + l];
}

void Motion::project_springs(const Batch& b, Quantity x0, Quantity d, float h) {
  const ProjectArguments arguments{h, float(1 / b.model->particle_mass), b.moves.data()};
  const KernelMesh& mesh = parts_.meshes(b);
  for (const KernelSprings* list : {&mesh.structural, &mesh.bend, &mesh.shear})
    force_kernels(b.width).project_springs(b.used, arguments, *list, field(std::as_const(array(x0)), b.base),
                                           field(array(d), b.base));
}

void xpbd(Motion& motion, const Worker& worker, const Substep& substep) {
  constexpr Quantity start = scratch(0), displacements = velocities;
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) {
    motion.other_forces(*batch);
    motion.kick(*batch, substep.h);
    motion.copy(*batch, positions, start);
    motion.drift(*batch, substep.h);
    motion.scale(*batch, velocities, substep.h);
    motion.project_gas(*batch, displacements, substep.h);
    motion.project_springs(*batch, start, displacements, substep.h);
    motion.scale(*batch, displacements, 1 / substep.h);
    motion.copy(*batch, start, positions);  // hand and contacts see where the velocities lead to from here
    motion.pull(*batch, substep.h);
  }
  motion.contacts(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.drift(*batch, substep.h);
  worker.barrier();
}

}  // namespace softbody
