#include "softbody/integrate/implicit/contact_forces.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "softbody/contact/law.h"

namespace softbody {
namespace {

// Contacts moved by contacts, of one body in a solve, for each of the two ways to find its forces: those that were
// found in `report stability --quick` took 1e6 at most, those that were not up to 3e7.
constexpr double max_moves = 4e6;
constexpr double work_of_a_move = 1.0 / 256;  // of an iteration for one particle in all lanes: 5 ns to 0.7 us
constexpr std::size_t max_active = 300;       // their compliances among one another grow with the square

/// A contact that presses, or that is passed.
struct ActiveContact {
  PlaneContact* contact;
  glm::dvec3 displacement;  // m, of its point in this step
  glm::dvec3 before;        // N, the force before the sweeps
  glm::dvec3 change{0.0};   // N, of the force in a sweep
  glm::dvec3 search{0.0};   // N
};

/// The forces between some points of one body and their planes, by projected Gauss-Seidel. Most of its time is
/// add().
class ForceSweeps {
 public:
  explicit ForceSweeps(std::vector<ActiveContact>& active)
      : active_(active), n_(active.size()), compliance_(9 * n_ * n_) {
    for (std::size_t k = 0; k < 3; ++k)
      for (const ActiveContact& a : active) moved_[k].push_back(a.displacement[int(k)]);
  }
  /// Sets how far (m/N) the point of contact j moves under a force on the one of contact i.
  void set_compliance(std::size_t i, std::size_t j, const glm::dmat3& block) {
    for (std::size_t k = 0; k < 9; ++k) compliance_[(9 * i + k) * n_ + j] = block[int(k / 3)][int(k % 3)];
  }

  /// How far (m) a force's change has moved its own point: in any sweep, and in the last one.
  struct Moved {
    double most, last;
  };
  /// Sweeps until no force's change moves its point by more than `enough` m, or a window of sweeps does not halve
  /// these moves, or more than `moves` contacts have been moved by contacts, which it counts down: there may be no such
  /// forces where a crushed body is pressed together. As few points of a stiff body move together, plain sweeps
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
      for (const ActiveContact& a : active_) square += glm::dot(a.change, a.change);
      extrapolate(before > 0 ? square / before : 0);
      before = square;
    }
  }

 private:
  /// Brings each contact's force up to date in turn. Returns how far (m) a change has moved its own point at most.
  double sweep() {
    double most = 0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      ActiveContact& a = active_[i];
      const PlaneContact& c = *a.contact;
      const glm::dmat3 own = own_compliance(i);
      const glm::dvec3 moved(moved_[0][i], moved_[1][i], moved_[2][i]);
      const double gives = glm::dot(c.normal, own * c.normal), along = glm::dot(moved, c.normal);
      const double before = glm::dot(c.force, c.normal);
      const double press = std::max(0.0, before + (c.min_displacement - along) / gives);
      // Across, the mean of the two other principal compliances.
      const double gives_across = 0.5 * (own[0][0] + own[1][1] + own[2][2] - gives);
      const glm::dvec3 drag = c.force - before * c.normal - (moved - along * c.normal) / gives_across;
      a.change = press * c.normal + law::within_cone(drag, c.friction * press) - c.force;
      if (a.change != glm::dvec3(0.0)) add(i, a.change);
      most = std::max(most, glm::length(own * a.change));
    }
    return most;
  }

  /// Changes the forces once more by `share` of the last search, which becomes the new search with the last changes.
  /// Starts a new one where the share shows no descent.
  void extrapolate(double share) {
    for (std::size_t i = 0; i < active_.size(); ++i) {
      const glm::dvec3 on = share < 1 ? share * active_[i].search : glm::dvec3(0.0);
      if (on != glm::dvec3(0.0)) add(i, on);
      active_[i].search = share < 1 ? on + active_[i].change : glm::dvec3(0.0);
    }
  }

  /// Adds to a force, and moves all points by that.
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

  std::vector<ActiveContact>& active_;
  std::size_t n_;
  std::array<std::vector<double>, 3> moved_;  // m, in this step
  std::vector<double> compliance_;            // of contact i: nine times n, so that add() runs along them
};

/// Returns the contacts of one lane that press or are passed.
std::vector<ActiveContact> active_contacts(const ImplicitProblem& p, std::span<PlaneContact> contacts, const Lanes& x) {
  std::vector<ActiveContact> active;
  for (PlaneContact& c : contacts) {
    const glm::dvec3 displacement = p.displacement(x, c.point);
    if (c.force != glm::dvec3(0.0) || glm::dot(displacement, c.normal) < c.min_displacement)
      active.push_back({&c, displacement, c.force});
  }
  return active;
}

}  // namespace

void ContactForces::start(bool springs_lead) {
  springs_lead_ = springs_lead;
  moves_left_.fill(max_moves);
}

glm::dvec3 ContactForces::force(const ImplicitProblem& p, const PlaneContact& c, const glm::dvec3& u) const {
  if (!springs_lead_) return c.force;
  const double k = p.matrix.contact_stiffness(), along = glm::dot(u, c.normal), held = glm::dot(c.force, c.normal);
  const double press = std::max(0.0, held + k * (c.min_displacement - along));
  if (press <= 0) return glm::dvec3(0.0);
  const glm::dvec3 drag = c.force - held * c.normal - k * (u - along * c.normal);
  return press * c.normal + law::within_cone(drag, c.friction * press);
}

double ContactForces::update(const ImplicitProblem& p, std::span<PlaneContact> contacts, const Lanes& x,
                             const glm::dmat3& rotation, Lanes& changes) {
  const double none_found = springs_lead_ ? 0 : std::numeric_limits<double>::infinity();
  double& moves_left = moves_left_[contacts.front().point.lane()];
  std::vector<ActiveContact> active = active_contacts(p, contacts, x);
  if (active.size() > max_active || moves_left <= 0) return none_found;
  ForceSweeps sweeps(active);
  const glm::dmat3 back = glm::transpose(rotation);
  const auto compliance = [&](const BodyPoint& moved, const BodyPoint& pushed) {
    return moved.mean([&](std::size_t i) {
      return pushed.mean(
          [&](std::size_t j) { return p.matrix.compliance(Index(i / implicit_lanes), Index(j / implicit_lanes)); });
    });
  };
  for (std::size_t i = 0; i < active.size(); ++i)
    for (std::size_t j = 0; j < active.size(); ++j)
      sweeps.set_compliance(i, j, rotation * compliance(active[j].contact->point, active[i].contact->point) * back);
  const double moves_before = moves_left;
  const auto [most, last] = sweeps.run(1e-9 * p.model.radius, moves_left);
  work_ += (moves_before - moves_left) * work_of_a_move;
  // While springs lead, the matrix may say nothing of the body. Then the forces are left to the springs.
  const bool trusted = springs_lead_ ? most <= p.model.radius : last <= held_within * p.model.radius;
  for (const ActiveContact& a : active) {
    if (!trusted) a.contact->force = a.before;
    a.contact->point.add_to(changes, a.contact->force - a.before);
  }
  return trusted ? most : none_found;
}

}  // namespace softbody
