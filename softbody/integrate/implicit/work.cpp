#include "softbody/integrate/implicit/work.h"

#include "softbody/integrate/implicit/frames.h"

namespace softbody {

ImplicitWork::ImplicitWork(const BodyModel& model, const ImplicitKernels& kernels) : solver(model, kernels) {
  for (Lanes* field : {&x, &v, &end_x, &end_v, &solved_v, &a, &frame_displacement, &stage_x, &stage_v, &stage_a})
    field->resize(3 * model.mesh.vertices.size() * implicit_lanes);
}

ImplicitProblem ImplicitWork::problem(const BodyModel& model, const ImplicitMatrix& matrix,
                                      const ImplicitFrames& frames, double h) {
  for (std::size_t l = 0; l < implicit_lanes; ++l) moves[l] = frames.active()[l] ? 1.0f : 0.0f;
  local_x = x, local_v = v;
  frames.enter(local_x, local_v, frame_displacement);
  frames.accelerations(local_x, local_v, a);
  return {model, matrix, h, moves.data(), &local_x, &local_v, &a, &frame_displacement, frames.step()};
}

void ImplicitWork::finish(const ImplicitFrames& frames) {
  frames.leave(solved_x, solved_v);
  for (std::size_t i = 0; i < solved_x.size(); ++i)
    if (frames.active()[i % implicit_lanes]) end_x[i] = solved_x[i], end_v[i] = solved_v[i];
}

}  // namespace softbody
