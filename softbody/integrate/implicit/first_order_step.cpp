#include "softbody/integrate/implicit/attempts.h"
#include "softbody/integrate/implicit/energy.h"
#include "softbody/integrate/implicit/momentum.h"
#include "softbody/integrate/implicit/planes.h"

namespace softbody {

LaneMask first_order_step(const ImplicitStep& step, ImplicitWork& work, LaneMask tried) {
  const ImplicitFrames frames = step.frames.subset(tried);
  ImplicitProblem problem = work.problem(step.model, step.matrix, frames, step.h);
  std::vector<PlaneContact> planes;
  std::vector<LinearPenaltyPair> pairs;
  for (const PlaneContact& c : work.planes)
    if (tried[c.at % lanes]) planes.push_back(frames.enter(c));
  for (const LinearPenaltyPair& s : work.penalty_pairs)
    if (tried[s.at % lanes]) pairs.push_back(frames.enter(s));
  problem.planes = planes, problem.penalty_pairs = pairs;
  work.solved_x = work.solver.solve(problem);
  for (std::size_t i = 0; i < work.x.size(); ++i) work.solved_v[i] = (work.solved_x[i] - work.local_x[i]) / step.h;
  work.finish(frames);
  LaneMask pushed;  // by solids
  auto solved_plane = planes.begin();
  for (PlaneContact& c : work.planes) {
    const std::size_t lane = c.at % lanes;
    if (!tried[lane]) continue;
    c.force = frames.leave(lane, solved_plane++->force);
    if (c.force != glm::dvec3(0.0)) pushed.set(lane);
  }
  restore_momentum(step, work, tried & ~pushed);
  clear_planes(work, tried, step.h);
  LaneMask solved;
  for (std::size_t l = 0; l < lanes; ++l) {
    if (!tried[l] || !satisfies_momentum_balance(step.model, work, l, step.h, step.gravity)) continue;
    const double gain = energy_gain(step.model, work, l, step.gravity, pushed[l]);
    solved[l] = dissipate(step.model, work, l, gain, pushed[l]);
  }
  return solved;
}

}  // namespace softbody
