#pragma once
// The attempts at an implicit step, in the order in which they are made.

#include <array>
#include <cmath>

#include "softbody/integrate/implicit/matrix.h"
#include "softbody/integrate/implicit/moving_axes.h"
#include "softbody/integrate/implicit/quasi_newton.h"

namespace softbody {

/// gamma of Alexander's method (1977): the length of both its stages over that of the step.
inline const double implicit_stage = 1 - std::sqrt(0.5);

/// What attempts know of a step beside its bodies, and what they solve it with.
struct ImplicitStep {
  const BodyModel& model;
  const ImplicitMatrix &matrix, &stage_matrix;  // for steps of h, and of implicit_stage h
  double h;                                     // s
  glm::dvec3 gravity;                           // m/s^2
  MovingAxes axes;                              // of the lanes that move
  QuasiNewton& solver;
  ImplicitStart& start;   // memory for that of a solve
  LaneMask in_contact{};  // lanes whose bodies touch something at the start
};

// An attempt sets the end of the lanes `tried` (bodies.end_x and end_v) and leaves the other lanes as they are. It uses
// the step's solver and memory. It returns the lanes that it has solved; the end of the rest is not to be used.

/// Takes a step of second order, in two stages, in those of the lanes that touch nothing. Springs, gas and dampers
/// enter by Alexander's method, what else acts in moving axes by the explicit one that goes with it (Ascher, Ruuth and
/// Spiteri 1997, "Implicit-explicit Runge-Kutta methods", (2,2,2)). Refuses lanes whose solve does not converge, that
/// end behind a plane, or that gain energy.
LaneMask second_order_step(ImplicitStep& step, ImplicitBodies& bodies, LaneMask tried);

/// Takes a step of backward Euler with contact in the solve. Fills in the forces of the lanes' planes. Refuses lanes
/// whose momentum does not change as the forces say, or that gain more energy than can be dissipated.
LaneMask first_order_step(ImplicitStep& step, ImplicitBodies& bodies, LaneMask tried);

/// Moves and rotates each body as a rigid body that stops at its planes. If that would give it energy, it rotates about
/// its angular momentum instead; if that does, too, its spin is reduced. Its shape does not change, and its deformation
/// velocities are lost. A body that is held stops. Refuses no lane.
LaneMask rigid_fallback_step(ImplicitStep& step, ImplicitBodies& bodies, LaneMask tried);

/// Each is made in the lanes that those before it have left open. The last one solves all of them.
inline constexpr std::array implicit_attempts{second_order_step, first_order_step, rigid_fallback_step};

}  // namespace softbody
