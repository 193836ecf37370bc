#pragma once
// The integrators' steps, one file each; integrators.cpp lists them. a(x, v) is force over mass, gravity included.
// Contacts act on velocities: on those that a step drifts by, so that it ends outside of all solids, and once more on
// those that it ends with where they have been changed since.

#include "softbody/integrate/integrators.h"

namespace softbody {

/// x += h v, then v += h a(x, v) of the old state. First order; without damping unstable at every step.
void explicit_euler(Motion& motion, const BatchShare& share, const Substep& substep);

/// Symplectic: v += h a(x, v), then x += h v. First order.
void semi_implicit_euler(Motion& motion, const BatchShare& share, const Substep& substep);

/// The same, but that the gas acts implicitly in the one mode in which the volume changes, see Volumes. Breathing, by
/// far the fastest oscillation of a ball of air, is damped within a few substeps instead of setting their length. First
/// order (Ascher, Ruuth and Wetton 1995, "Implicit-explicit methods for time-dependent partial differential
/// equations").
void imex_euler(Motion& motion, const BatchShare& share, const Substep& substep);

/// v += h/2 a, x += h v, v += h/2 a at the new positions, where the dampers see the predicted velocity v + h/2 a of
/// old: with a lagging one the second order is lost. One evaluation a step.
void velocity_verlet(Motion& motion, const BatchShare& share, const Substep& substep);

/// The classical Runge-Kutta method of fourth order; what contacts change of its mean velocity they change at the end.
void runge_kutta_4(Motion& motion, const BatchShare& share, const Substep& substep);

/// Extended position-based dynamics (Macklin, Mueller and Chentanez 2016) with one pass a substep (Macklin et al.
/// 2019): springs with their dampers and the gas are constraints of finite compliance, all else are forces.
void xpbd(Motion& motion, const BatchShare& share, const Substep& substep);

/// Where nothing touches: the L-stable diagonally implicit Runge-Kutta method of second order with two stages
/// (Alexander 1977), both with the same matrix. Elsewhere: backward Euler with contact in the solve. Both in a frame
/// that moves with the body. implicit/attempts.h says what is tried in which order. Linear and angular momentum are
/// restored after each step in which no solid pushes.
void implicit_step(Motion& motion, const BatchShare& share, const Substep& substep);

}  // namespace softbody
