#pragma once
// The problem of one implicit step of the bodies in all lanes, and what touches them.

#include <algorithm>
#include <array>
#include <bitset>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/implicit/matrix.h"
#include "softbody/state/lanes.h"

namespace softbody {

/// One flag a lane.
using LaneMask = std::bitset<implicit_lanes>;

/// A point of a body: a particle, or the point of a face or an edge that follows its corners by their weights.
struct BodyPoint {
  std::array<std::size_t, 3> at{};        // particle * implicit_lanes + lane
  std::array<double, 3> weight{1, 0, 0};  // their sum is 1

  std::size_t lane() const { return at[0] % implicit_lanes; }
  /// Returns the weighted mean of value(at).
  template <class Value>
  auto mean(const Value& value) const {
    auto sum = weight[0] * value(at[0]);
    for (std::size_t k = 1; k < 3; ++k)
      if (weight[k] != 0) sum += weight[k] * value(at[k]);
    return sum;
  }
  /// Returns how far the point moves if each corner moves by its weight.
  double square_of_weights() const { return weight[0] * weight[0] + weight[1] * weight[1] + weight[2] * weight[2]; }
  /// Adds a value to each corner, times its weight.
  void add_to(Lanes& sums, const glm::dvec3& value) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (weight[k] != 0) add(sums, at[k], weight[k] * value);
  }
};

/// The plane of a solid that a point must stay in front of, and the contact force.
struct PlaneContact {
  BodyPoint point;
  double friction, restitution;
  glm::dvec3 normal;        // unit
  double min_displacement;  // m, that it has to move along the normal in this step
  glm::dvec3 force{0.0};    // N

  double out() const { return std::max(0.0, min_displacement); }  // m, that takes it out of the solid
};

/// The penalty contact between a particle of the batch and one of another body, to first order.
struct LinearPenaltyPair {
  PenaltyEnd end{};   // the particle's, of the pair
  std::size_t at;     // particle * implicit_lanes + lane
  glm::dvec3 normal;  // unit, towards the particle
  PenaltyContact::Slopes slopes;
  glm::dvec3 force{0.0};  // N, on it at the start
  double friction = 0;
  double share = 1;         // of the pair's impulse and energy: a half if the other particle moves; 0 if it did not act
  glm::dvec3 partner{0.0};  // m, how far the other particle is taken to move
  glm::dvec3 start_separation{0.0};  // m, how far the two separate at the first velocities; in `force`
  double max_work = 0;               // J, that it can do in the step, whatever force_after() says

  /// Returns the force (N) after the particle has moved by u. It never pulls, and friction does not exceed its limit.
  glm::dvec3 force_after(const glm::dvec3& u) const {
    const glm::dvec3 apart = u - partner, faster = apart - start_separation;
    const double press = std::max(0.0, glm::dot(force, normal) - double(slopes.spring) * glm::dot(apart, normal) -
                                           double(slopes.damper) * glm::dot(faster, normal));
    const auto across = [this](const glm::dvec3& v) { return v - glm::dot(v, normal) * normal; };
    // The friction spring of the start has slipped for this step already, see PenaltyContact::evaluate().
    const glm::dvec3 drag = across(force) - double(slopes.across_spring + slopes.across_damper) * across(faster);
    return press * normal + law::within_cone(drag, friction * press);
  }
};

/// A particle that is held, and where it is at the end of a step.
struct HeldEnd {
  std::size_t at;    // particle * implicit_lanes + lane
  glm::dvec3 place;  // m
};

/// The bodies in all lanes in the world, at the start and at the end of a step, and what touches them.
struct ImplicitBodies {
  explicit ImplicitBodies(const BodyModel& model) {
    for (Lanes* field : {&x, &v, &end_x, &end_v}) field->resize(3 * model.mesh.vertices.size() * implicit_lanes);
  }

  Lanes x, v, end_x, end_v;                      // m and m/s
  std::vector<PlaneContact> planes;              // ordered by lanes ...
  std::vector<LinearPenaltyPair> penalty_pairs;  // ... these in any order
  std::vector<HeldEnd> held;                     // lane after lane
  LaneMask holds, holds_move;                    // lanes with held particles, and with such as move
};

/// The start of a step in the axes of the lanes (implicit/moving_axes.h).
struct ImplicitStart {
  Lanes x, v;     // m and m/s
  Lanes a;        // m/s^2, what acts beside the forces
  Lanes carried;  // m, how far the axes carry particles that keep their places in them
  std::array<float, implicit_lanes> moves{};
  std::vector<HeldEnd> held{};
};

/// What is solved in one step, in the axes of the lanes.
struct ImplicitProblem {
  const BodyModel& model;
  const ImplicitMatrix& matrix;
  double h;  // s
  const ImplicitStart& start;
  double carry_time;                 // s, in which the axes do so
  std::span<PlaneContact> planes{};  // ordered by lanes; their forces are filled in
  std::span<const LinearPenaltyPair> penalty_pairs{};

  /// Returns the displacement (m) in this step of a particle whose position is now in `now`.
  glm::dvec3 displacement(const Lanes& now, std::size_t at) const {
    return read(now, at) - read(start.x, at) + read(start.carried, at);
  }
  glm::dvec3 displacement(const Lanes& now, const BodyPoint& point) const {
    return point.mean([&](std::size_t at) { return displacement(now, at); });
  }
};

}  // namespace softbody
