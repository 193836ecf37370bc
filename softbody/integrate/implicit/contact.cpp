// ImplicitSolver: the forces between particles and solids.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "softbody/contact/law.h"
#include "softbody/integrate/implicit/planes.h"

namespace softbody {
namespace {

constexpr double none_found = std::numeric_limits<double>::infinity();  // m, for moves by forces that hold nowhere
constexpr double held_within = 1e-7;  // of the radius: forces hold where their changes move no particle further
// Contacts moved by contacts, of one body in a solve, for each of the two ways to find its forces: those that were
// found in `report stability --quick` took 1e6 at most, those that were not up to 3e7.
constexpr double max_moves = 4e6;
constexpr double work_of_a_move = 1.0 / 256;  // of an iteration for one particle in all lanes: 5 ns to 0.7 us

/// A contact that presses or is passed.
struct Active {
  PlaneContact* contact;
  glm::dvec3 moved;        // m, in this step
  glm::dvec3 before;       // N
  glm::dvec3 change{0.0};  // N, in a sweep
  glm::dvec3 search{0.0};  // N
};

/// The forces between some particles of one body and their planes, by projected Gauss-Seidel. Most of its time is
/// add().
class ForceSweeps {
 public:
  explicit ForceSweeps(std::vector<Active>& active) : active_(active), n_(active.size()), compliance_(9 * n_ * n_) {
    for (std::size_t k = 0; k < 3; ++k)
      for (const Active& a : active) moved_[k].push_back(a.moved[int(k)]);
  }
  /// m/N: of contact j to a force on contact i.
  void set_compliance(std::size_t i, std::size_t j, const glm::dmat3& block) {
    for (std::size_t k = 0; k < 9; ++k) compliance_[(9 * i + k) * n_ + j] = block[int(k / 3)][int(k % 3)];
  }

  struct Moved {
    double most, last;  // m: how far a force's change has moved its particle, in any sweep and in the last one
  };
  /// Until no force's change moves its particle by more than `enough` m, or a window of sweeps does not halve these
  /// moves, or more than `moves` contacts have been moved by contacts, which it counts down: there may be no such
  /// forces where a crushed body is pressed together. As few particles of a stiff body move together, plain sweeps
  /// would hardly converge: they are the gradient of a nonlinear conjugate gradient method (Silcowitz, Niebe and
  /// Erleben 2010).
  Moved run(double enough, double& moves) {
    constexpr int max_sweeps = 600, window = 50;
    double most = 0, before = 0, sum = 0, sum_before = std::numeric_limits<double>::infinity();
    for (int s = 1;; ++s) {
      const double moved = sweep();
      most = std::max(most, moved);
      sum += moved;
      moves -= double(n_ * n_);
      if (moved <= enough || s == max_sweeps || moves <= 0) return {most, moved};
      if (s % window == 0) {
        if (!(sum < 0.5 * sum_before)) return {most, moved};
        sum_before = std::exchange(sum, 0.0);
      }
      double square = 0;
      for (const Active& a : active_) square += glm::dot(a.change, a.change);
      extrapolate(before > 0 ? square / before : 0);
      before = square;
    }
  }

 private:
  double sweep() {
    double most = 0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      Active& a = active_[i];
      const PlaneContact& c = *a.contact;
      const glm::dmat3 own = own_compliance(i);
      const glm::dvec3 moved(moved_[0][i], moved_[1][i], moved_[2][i]);
      const double gives = glm::dot(c.normal, own * c.normal), along = glm::dot(moved, c.normal);
      const double before = glm::dot(c.force, c.normal),
                   press = std::max(0.0, before + (c.min_displacement - along) / gives);
      // Across, the mean of the two other principal compliances.
      const double gives_across = 0.5 * (own[0][0] + own[1][1] + own[2][2] - gives);
      const glm::dvec3 drag = c.force - before * c.normal - (moved - along * c.normal) / gives_across;
      a.change = press * c.normal + law::within_cone(drag, c.friction * press) - c.force;
      if (a.change != glm::dvec3(0.0)) add(i, a.change);
      most = std::max(most, glm::length(own * a.change));
    }
    return most;
  }

  /// Goes on by `share` of the way that led here; from anew where that is no descent.
  void extrapolate(double share) {
    for (std::size_t i = 0; i < active_.size(); ++i) {
      const glm::dvec3 on = share < 1 ? share * active_[i].search : glm::dvec3(0.0);
      if (on != glm::dvec3(0.0)) add(i, on);
      active_[i].search = share < 1 ? on + active_[i].change : glm::dvec3(0.0);
    }
  }

  void add(std::size_t i, const glm::dvec3& force) {
    active_[i].contact->force += force;
    const double* columns = &compliance_[9 * i * n_];
    for (std::size_t k = 0; k < 3; ++k) {
      double* moved = moved_[k].data();
      const double *x = columns + k * n_, *y = x + 3 * n_, *z = y + 3 * n_;
      for (std::size_t j = 0; j < n_; ++j) moved[j] += x[j] * force.x + y[j] * force.y + z[j] * force.z;
    }
  }

  glm::dmat3 own_compliance(std::size_t i) const {
    glm::dmat3 block;
    for (std::size_t k = 0; k < 9; ++k) block[int(k / 3)][int(k % 3)] = compliance_[(9 * i + k) * n_ + i];
    return block;
  }

  std::vector<Active>& active_;
  std::size_t n_;
  std::array<std::vector<double>, 3> moved_;  // m, in this step
  std::vector<double> compliance_;            // of contact i: nine times n, so that add() runs along them
};

}  // namespace

/// Of a particle that has moved by u: the force held and, while springs lead, one on what is left to correct.
glm::dvec3 ImplicitSolver::contact_force(const ImplicitProblem& p, const PlaneContact& c, const glm::dvec3& u) const {
  if (!contact_springs_) return c.force;
  const double k = p.matrix.contact_stiffness(), along = glm::dot(u, c.normal), held = glm::dot(c.force, c.normal);
  const double press = std::max(0.0, held + k * (c.min_displacement - along));
  if (press <= 0) return glm::dvec3(0.0);
  const glm::dvec3 drag = c.force - held * c.normal - k * (u - along * c.normal);
  return press * c.normal + law::within_cone(drag, c.friction * press);
}

/// The prediction stops as one where planes stop it: behind, it would start far inside the solid.
void ImplicitSolver::stop_at_planes(const ImplicitProblem& p) {
  std::array<bool, implicit_lanes> any{};
  for (const PlaneContact& c : *p.planes) any[c.at % implicit_lanes] = true;
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!any[l]) continue;
    glm::dvec3 meant(0.0);
    for (std::size_t i = l; i < stride_; i += implicit_lanes) meant += moved(p, x_, i) / double(particles_);
    const glm::dvec3 less =
        stop_at(*p.planes, l, p.h, meant, [&](std::size_t i) { return moved(p, x_, i * implicit_lanes + l) - meant; }) -
        meant;
    for (std::size_t i = l; i < stride_; i += implicit_lanes) add(x_, i, less);
  }
}

/// Rounds that each leave a fraction of the error where the matrix says what the body does. Returns in which lanes they
/// have come to an end.
std::array<bool, implicit_lanes> ImplicitSolver::solve_contact_forces(const ImplicitProblem& p) {
  constexpr int max_rounds = 30, look_every = 2;
  constexpr double enough_progress = 0.25;  // of the moves are left: where it is more, the end would not be reached
  const double enough = held_within * p.model.radius;
  contact_springs_ = false;
  std::array<bool, implicit_lanes> held{};
  given_up_ = {};
  moves_left_.fill(max_moves);
  PerLane last;
  last.fill(none_found);
  for (int round = 0; round < max_rounds; ++round) {
    minimise(p, iterations_of_round);
    const PerLane moved = project_contacts(p);
    bool open = false;
    for (std::size_t l = 0; l < implicit_lanes; ++l) {
      held[l] = !given_up_[l] && converged_[l] && moved[l] <= enough;
      const bool look = round % look_every == 0 && moved[l] > 0;
      const double less_than = look ? enough_progress * last[l] : none_found;
      given_up_[l] = given_up_[l] || (!(moved[l] <= enough) && !(moved[l] < less_than));
      if (look) last[l] = moved[l];
      open = open || !(held[l] || given_up_[l]);
    }
    if (!open) break;
  }
  return held;
}

/// Robust rather than exact: what they end with need not be where all is in balance.
void ImplicitSolver::solve_penalty(const ImplicitProblem& p) {
  constexpr int max_rounds = 8;
  contact_springs_ = true;
  given_up_ = {};
  moves_left_.fill(max_moves);
  for (int round = 0; round < max_rounds; ++round) {
    project_contacts(p);
    const bool settled = minimise(p, iterations_of_round);
    double most = 0;
    for (PlaneContact& c : *p.planes) {
      const glm::dvec3 force = contact_force(p, c, moved(p, x_, c.at));
      most = std::max(most, glm::length(force - c.force));
      c.force = force;
    }
    if (settled && most <= 1e-7 * p.model.radius * p.matrix.contact_stiffness()) break;
  }
}

/// Brings the contact forces up to date with the positions, and these with the forces' changes, but for lanes that are
/// given up. Returns how far these have moved a particle at most, in m; infinity: there are none to be found.
ImplicitSolver::PerLane ImplicitSolver::project_contacts(const ImplicitProblem& p) {
  PerLane moved{}, once;
  direction_.assign(direction_.size(), 0.0);  // first the forces' changes, then what they move
  std::vector<PlaneContact>& planes = *p.planes;
  for (std::size_t first = 0; first < planes.size();) {
    const std::size_t lane = planes[first].at % implicit_lanes;
    std::size_t end = first;
    while (end < planes.size() && planes[end].at % implicit_lanes == lane) ++end;
    if (!given_up_[lane]) moved[lane] = project_contacts_of_lane(p, std::span(planes).subspan(first, end - first));
    first = end;
  }
  if (std::ranges::max(moved) <= 0) return moved;
  apply_matrix(p, direction_);
  once.fill(1.0);
  add_scaled(once, direction_, x_);
  return moved;
}

/// The forces of one lane's contacts that press or are passed. Adds their changes to direction_; returns what
/// project_contacts() does.
double ImplicitSolver::project_contacts_of_lane(const ImplicitProblem& p, std::span<PlaneContact> all) {
  const std::size_t lane = all.front().at % implicit_lanes;
  glm::dmat3 rotation(1.0);
  if (p.matrix.rotates())
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) rotation[c][r] = rotation_[3 * c + r][lane];
  std::vector<Active> active;
  for (PlaneContact& c : all) {
    const glm::dvec3 by = moved(p, x_, c.at);
    if (c.force != glm::dvec3(0.0) || glm::dot(by, c.normal) < c.min_displacement) active.push_back({&c, by, c.force});
  }
  const std::size_t n = active.size();
  constexpr std::size_t max_active = 300;  // their compliances among one another grow with the square
  const double without = contact_springs_ ? 0 : none_found;
  if (n > max_active || moves_left_[lane] <= 0) return without;
  ForceSweeps sweeps(active);
  const glm::dmat3 back = glm::transpose(rotation);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      sweeps.set_compliance(i, j,
                            rotation *
                                p.matrix.compliance(Index(active[j].contact->at / implicit_lanes),
                                                    Index(active[i].contact->at / implicit_lanes)) *
                                back);
  const double moves_before = moves_left_[lane];
  const auto [most, last] = sweeps.run(1e-9 * p.model.radius, moves_left_[lane]);
  work_ += (moves_before - moves_left_[lane]) * work_of_a_move;
  // While springs lead the matrix may say nothing of a body that is crushed: then those of contact_force() have to do.
  const bool trusted = contact_springs_ ? most <= p.model.radius : last <= held_within * p.model.radius;
  for (const Active& a : active) {
    if (!trusted) a.contact->force = a.before;
    add(direction_, a.contact->at, a.contact->force - a.before);
  }
  return trusted ? most : without;
}

}  // namespace softbody
