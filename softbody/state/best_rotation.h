#pragma once

#include <glm/mat3x3.hpp>

namespace softbody {

/// Returns the rotation R for which trace(R^T covariance) is largest, with covariance = the sum of x q^T: Horn's
/// quaternion (1987, "Closed-form solution of absolute orientation using unit quaternions"). It is never a reflection.
/// If there are several such rotations, it is any one of them.
glm::dmat3 best_rotation(const glm::dmat3& covariance);

}  // namespace softbody
