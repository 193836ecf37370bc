#pragma once
// What keeps a body's shape: shape matching (Mueller, Heidelberger, Teschner, Gross 2005, "Meshless deformations based
// on shape matching") as a force. Each particle is drawn to where it would be if the body were rigid,
//
//   f_i = m w^2 (g_i - x_i),   g_i = c + R q_i,
//
// with q_i its resting place from the mean of all, c the particles' mean and R the rotation that brings the q_i nearest
// to them. It is the gradient of 1/2 m w^2 sum |x_i - g_i|^2, minimal in c and R, so that it changes neither linear nor
// angular momentum; a maximum over rotations is convex in x, so that w^2 bounds its stiffness over mass in every state.

#include "softbody/forces/kernel_types.h"
#include "softbody/model/body_model.h"

namespace softbody {

/// Where the goal shape goes in each of the first `used` lanes; the others stay as they are.
template <class Real>
void fit_shape(const ShapeMoments<Real>& moments, int used, ShapePose<Real>& pose);

/// m w^2 in N/m: what draws one particle.
double shape_stiffness(const BodyModel& model);

/// In J, of one body with its particles at x; 0 if it does not keep its shape.
double shape_energy(const BodyModel& model, const std::vector<glm::dvec3>& x);

}  // namespace softbody
