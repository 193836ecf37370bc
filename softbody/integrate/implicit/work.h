#pragma once
// What a thread computes with while it solves steps of one body model.

#include <vector>

#include "softbody/integrate/implicit/frames.h"
#include "softbody/integrate/implicit/solver.h"

namespace softbody {

/// The start and the end of a step of the bodies in all lanes, what touches them, and memory for the attempts.
struct ImplicitWork {
  ImplicitWork(const BodyModel& model, const ImplicitKernels& kernels) : solver(model, kernels) {
    for (Lanes* field : {&x, &v, &end_x, &end_v, &solved_v, &a, &frame_displacement, &stage_x, &stage_v, &stage_a})
      field->resize(3 * model.mesh.vertices.size() * implicit_lanes);
  }

  /// Returns the problem of a step of h with the matrix, for the lanes that have a frame of their own: it begins at x,
  /// v, and nothing touches the bodies.
  ImplicitProblem problem(const BodyModel& model, const ImplicitMatrix& matrix, const ImplicitFrames& frames,
                          double h) {
    for (std::size_t l = 0; l < implicit_lanes; ++l) moves[l] = frames.active()[l] ? 1.0f : 0.0f;
    local_x = x, local_v = v;
    frames.enter(local_x, local_v, frame_displacement);
    frames.accelerations(local_x, local_v, a);
    return {model, matrix, h, moves.data(), &local_x, &local_v, &a, &frame_displacement, frames.step()};
  }
  /// Takes solved_x and solved_v back into the world and makes them the end of the lanes that have a frame of their
  /// own. Leaves the other lanes as they are.
  void finish(const ImplicitFrames& frames) {
    frames.leave(solved_x, solved_v);
    for (std::size_t i = 0; i < solved_x.size(); ++i)
      if (frames.active()[i % implicit_lanes]) end_x[i] = solved_x[i], end_v[i] = solved_v[i];
  }

  ImplicitSolver solver;
  Lanes x, v, end_x, end_v;                      // m and m/s, in the world
  std::vector<PlaneContact> planes;              // in the world, ordered by lanes ...
  std::vector<LinearPenaltyPair> penalty_pairs;  // ... these in any order
  Lanes local_x, local_v;                        // the start in the lanes' frames ...
  Lanes solved_x, solved_v;                      // ... and the end, as it has been solved
  Lanes a, frame_displacement;                   // of the frames, see ImplicitProblem
  Lanes stage_x, stage_v, stage_a;               // where the second stage starts, and what acts in it
  std::array<float, implicit_lanes> moves{};
};

}  // namespace softbody
