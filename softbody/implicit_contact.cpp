// ImplicitSolver: the forces between particles and solids.

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "softbody/implicit_solver.h"

namespace softbody {

/// The prediction ends where the first particle meets its plane: beyond, it would start far inside the solid.
void ImplicitSolver::stop_at_planes(const ImplicitProblem& p) {
  PerLane part;
  part.fill(1.0);
  for (const PlaneContact& c : *p.planes) {
    const double along = glm::dot(read(x_, c.at) - read(*p.x, c.at), c.normal);
    if (along < c.need) part[c.at % lanes] = std::min(part[c.at % lanes], std::max(0.0, c.need / along));
  }
  for (std::size_t i = 0; i < 3 * stride_; ++i)
    if (part[i % lanes] < 1) x_[i] = (*p.x)[i] + part[i % lanes] * (x_[i] - (*p.x)[i]);
}

/// Brings the contact forces up to date with the positions, and these with the forces' changes.
void ImplicitSolver::press(const ImplicitProblem& p) {
  direction_.assign(direction_.size(), 0.0);  // first the forces' changes, then what they move
  double most = 0;
  std::vector<PlaneContact>& planes = *p.planes;
  for (std::size_t first = 0; first < planes.size();) {
    std::size_t end = first;
    while (end < planes.size() && planes[end].at % lanes == planes[first].at % lanes) ++end;
    most = std::max(most, press_lane(p, std::span(planes).subspan(first, end - first)));
    first = end;
  }
  if (most <= 0) return;
  apply_matrix(p, direction_);
  PerLane once;
  once.fill(1.0);
  add_scaled(once, direction_, x_);
}

/// Projected Gauss-Seidel over the contacts of one lane that press or are passed. Adds the changes of their forces to
/// direction_; returns how far these have moved a particle at most, in m.
double ImplicitSolver::press_lane(const ImplicitProblem& p, std::span<PlaneContact> all) {
  const std::size_t lane = all.front().at % lanes;
  glm::dmat3 rotation(1.0);
  if (p.matrix.turns())
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) rotation[c][r] = rotation_[3 * c + r][lane];
  struct Active {
    PlaneContact* contact;
    glm::dvec3 moved;   // m, in this step
    glm::dvec3 before;  // N
  };
  std::vector<Active> active;
  for (PlaneContact& c : all) {
    const glm::dvec3 moved = read(x_, c.at) - read(*p.x, c.at);
    if (c.force != glm::dvec3(0.0) || glm::dot(moved, c.normal) < c.need) active.push_back({&c, moved, c.force});
  }
  const std::size_t n = active.size();
  constexpr std::size_t most_active = 300;  // their compliances among one another grow with the square
  if (n > most_active) return 0;
  std::vector<glm::dmat3> compliance(n * n);
  const glm::dmat3 back = glm::transpose(rotation);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      compliance[i * n + j] =
          rotation * p.matrix.compliance(Index(active[i].contact->at / lanes), Index(active[j].contact->at / lanes)) *
          back;
  const double enough = 1e-9 * p.prototype.radius;
  double most = 0;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      PlaneContact& c = *active[i].contact;
      const glm::dmat3& own = compliance[i * n + i];
      const double gives = glm::dot(c.normal, own * c.normal), along = glm::dot(active[i].moved, c.normal);
      const double before = glm::dot(c.force, c.normal), press = std::max(0.0, before + (c.need - along) / gives);
      // Across, the mean of the two other principal compliances.
      const double gives_across = 0.5 * (own[0][0] + own[1][1] + own[2][2] - gives);
      glm::dvec3 drag = c.force - before * c.normal - (active[i].moved - along * c.normal) / gives_across;
      if (const double size = glm::length(drag), limit = c.friction * press; size > limit) drag *= limit / size;
      const glm::dvec3 change = press * c.normal + drag - c.force;
      c.force += change;
      for (std::size_t j = 0; j < n; ++j) active[j].moved += compliance[j * n + i] * change;
      largest = std::max(largest, glm::length(own * change));
    }
    most = std::max(most, largest);
    if (largest <= enough) break;
  }
  // So far the matrix says nothing of a body that is crushed: then the springs of contact_force() have to do.
  const bool trusted = most <= p.prototype.radius;
  for (const Active& a : active) {
    if (!trusted) a.contact->force = a.before;
    add(direction_, a.contact->at, a.contact->force - a.before);
  }
  return trusted ? most : 0;
}

}  // namespace softbody
