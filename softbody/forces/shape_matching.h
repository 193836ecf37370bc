#pragma once
// Shape matching (Mueller, Heidelberger, Teschner, Gross 2005, "Meshless deformations based on shape matching") as a
// force that keeps a body's shape. It pulls each particle to the place that it would have if the body were rigid,
//
//   f_i = m w^2 (g_i - x_i),   g_i = c + R q_i,
//
// where q_i is its place at rest relative to the mean of all, c is the mean of the particles, and R is the rotation
// that brings the q_i closest to the particles. The force is the gradient of 1/2 m w^2 sum |x_i - g_i|^2, which c and R
// minimise, so it changes neither linear nor angular momentum. A maximum over rotations is convex in x, so w^2 bounds
// the stiffness over mass in every state.

#include <array>

#include "softbody/forces/kernel_types.h"
#include "softbody/model/body_model.h"
#include "softbody/model/key.h"

namespace softbody {

inline constexpr double mesh_file_shape_frequency = 10;  // Hz

struct ShapeMatching {
  static constexpr auto frequency =
      Key("shape_frequency", "Hz", not_given, {0, 1e3},
          "Frequency with which a single particle swings about its place in the mesh's own shape. 0: the body does not "
          "keep its shape by itself.",
          {}, {.place = 40, .if_missing = "10 for meshes from files, else 0"});
  static constexpr std::array keys{&frequency};
};

/// Finds the pose of the goal shape in each of the first `used` lanes; the other lanes of `pose` are not changed.
template <class Real>
void fit_shape(const ShapeMoments<Real>& moments, int used, ShapePose<Real>& pose);

/// Returns m w^2 in N/m, the stiffness of the pull on one particle.
double shape_stiffness(const BodyModel& model);

/// Returns the energy in J of one body with its particles at x; 0 without shape matching.
double shape_energy(const BodyModel& model, const std::vector<glm::dvec3>& x);

}  // namespace softbody
