#include "softbody/integrate/implicit/attempts.h"
#include "softbody/integrate/implicit/energy.h"
#include "softbody/integrate/implicit/momentum.h"
#include "softbody/integrate/implicit/planes.h"

namespace softbody {

LaneMask second_order_step(const ImplicitStep& step, ImplicitWork& work, LaneMask tried) {
  LaneMask solved = tried & ~step.in_contact;
  if (solved.none()) return solved;
  const double h = step.h, stage = implicit_stage * h;
  const double second = 1 / (2 * implicit_stage);  // the second stage's share in what else acts
  const ImplicitFrames frames = step.frames.subset(solved).falling(h * h / 2 * step.gravity);
  ImplicitProblem problem = work.problem(step.model, step.stage_matrix, frames, stage);
  work.solved_x = work.solver.solve(problem);
  solved &= work.solver.converged();
  for (std::size_t i = 0; i < work.x.size(); ++i) {
    const double v = work.solved_v[i] = (work.solved_x[i] - work.local_x[i]) / stage;
    work.stage_x[i] = work.local_x[i] + (1 - implicit_stage) * h * v;
    work.stage_v[i] = work.local_v[i] + (1 - implicit_stage) / implicit_stage * (v - work.local_v[i]);
  }
  frames.accelerations(work.solved_x, work.solved_v, work.stage_a);
  for (std::size_t i = 0; i < work.x.size(); ++i)
    work.stage_a[i] = work.a[i] + second / implicit_stage * (work.stage_a[i] - work.a[i]);
  problem.x = &work.stage_x, problem.v = &work.stage_v, problem.a = &work.stage_a;
  work.solved_x = work.solver.solve(problem);
  solved &= work.solver.converged();
  for (std::size_t i = 0; i < work.x.size(); ++i) work.solved_v[i] = (work.solved_x[i] - work.stage_x[i]) / stage;
  work.finish(frames);
  restore_momentum(step, work, frames.active());
  solved &= ~behind_planes(work);
  for (std::size_t l = 0; l < lanes; ++l)
    if (solved[l]) solved[l] = energy_gain(step.model, work, l, step.gravity, false) <= 0;
  return solved;
}

}  // namespace softbody
