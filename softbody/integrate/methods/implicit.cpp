#include <algorithm>

#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void Dynamics::solve_implicit(const Worker& worker, Batch& b, Quantity mean, Quantity rest, float h) {
  const auto all = [](Components& c) { return Field<float>{c[0].data(), c[1].data(), c[2].data()}; };
  const auto index = static_cast<std::size_t>(&b - batches_.data());
  std::span<const PenaltyEnd> ends;
  if (!penalty_.pairs.empty())
    ends = std::span(penalty_.ends)
               .subspan(penalty_.first_end[index], penalty_.first_end[index + 1] - penalty_.first_end[index]);
  implicit_steps_.advance(worker.index(),
                          {.model = b.model,
                           .moves = b.moves,
                           .x = all(x_),
                           .v = all(v_),
                           .base = b.base,
                           .gravity = has_gravity_ ? scene_.gravity : glm::dvec3(0.0),
                           .near_solids = b.near_solids,
                           .penalty = penalty_,
                           .ends = ends,
                           .is_moving = [this](BodyId id) { return bodies_[id].moves(); }},
                          {.mean = all(components(mean)),
                           .rest = all(components(rest)),
                           .impulse = {b.impulse.x, b.impulse.y, b.impulse.z},
                           .returned = b.returned.data()},
                          double(h));
  // What solids throw back is in the solve: for the velocities' contact nothing has come at them.
  if (has_restitution_)
    for (LaneArray<float>& component : before_)
      std::fill_n(component.begin() + std::ptrdiff_t(b.base), b.values(), 0.0f);
}

void implicit_step(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  constexpr Quantity mean = scratch(0), rest = scratch(1);
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) dynamics.solve_implicit(worker, *batch, mean, rest, substep.h);
  worker.barrier();  // no thread still reads the velocities for penalty contacts
  for (Batch* batch : worker.batches()) {
    dynamics.copy(*batch, mean, velocities);
    dynamics.pull(*batch, substep.h);
  }
  dynamics.contacts(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.drift(*batch, substep.h);
    dynamics.add(*batch, velocities, 1, rest);
  }
  worker.barrier();
}

}  // namespace softbody
