// Dynamics: what the two stages of an implicit step make of a spin.

#include <cmath>
#include <complex>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/dynamics.h"
#include "softbody/implicit_stages.h"
#include "softbody/rigid_motion.h"

namespace softbody {
namespace {

using Complex = std::complex<double>;

Complex on_circle(const Complex& c) { return c / std::sqrt(std::norm(c)); }

/// By which the two stages' velocities of a body held rigid fall short of `spin` (rad/s) times the place at the end of
/// the step: its particles, each on its circle in the complex plane, go on chords.
glm::dmat3 missing_spin(const glm::dvec3& spin, double h) {
  constexpr Complex i(0, 1);
  const double speed = glm::length(spin), turn = h * speed;
  const Complex first = on_circle(1.0 + implicit_stage * turn * i), v = turn * i,
                stage_v = (first - 1.0) / implicit_stage;
  const Complex from = 1.0 + (1 - implicit_stage) * stage_v;
  const Complex end = on_circle(from + implicit_stage * v + (1 - implicit_stage) * (stage_v - v));
  const Complex less = turn * i - (end - from) / implicit_stage * std::conj(end);  // outwards, and along the circle
  const glm::dvec3 n = spin / speed;
  const glm::dmat3 along(0, n.z, -n.y, -n.z, 0, n.x, n.y, -n.x, 0);  // n x ...
  return less.real() / h * (glm::dmat3(1) - glm::outerProduct(n, n)) + less.imag() / h * along;
}

}  // namespace

/// A stiff body's velocities follow its positions, which lie on chords of the circles on which it spins: end_v gets
/// back what that takes from them. What swings freely has them right.
void Dynamics::straighten_spin(const Batch& b, ImplicitWork& work, const ImplicitProblem& second, double h) const {
  const std::size_t n = b.particles(), stride = n * lanes;
  bool any = false;
  work.missing.assign(3 * stride, 0.0);
  for (std::size_t l = 0; l < lanes; ++l) {
    const auto field = [&](const Lanes& f) {
      return [&f, l, stride](std::size_t i) {
        const std::size_t at = i * lanes + l;
        return glm::dvec3(f[at], f[at + stride], f[at + 2 * stride]);
      };
    };
    if (b.moves[l] <= 0) continue;
    // Chords turn too slowly: the spin is that of the momentum, which nothing changes here.
    const glm::dvec3 momentum = rigid_motion(n, field(work.x), field(work.v)).momentum;
    const RigidMotion m = rigid_motion(n, field(work.end_x), field(work.end_v));
    const glm::dvec3 spin = m.spin_of(momentum);
    if (!(h * glm::length(spin) > 1e-6)) continue;  // rad
    any = true;
    const glm::dmat3 missing = missing_spin(spin, h);
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec3 less = missing * (field(work.end_x)(i) - m.centre);
      for (std::size_t k = 0; k < 3; ++k) work.missing[i * lanes + l + k * stride] = less[int(k)];
    }
  }
  if (!any) return;
  work.solver.keep_stiff(second, work.missing);
  for (std::size_t i = 0; i < work.end_v.size(); ++i) work.end_v[i] += work.missing[i];
}

}  // namespace softbody
