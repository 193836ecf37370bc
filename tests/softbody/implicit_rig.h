#pragma once
// One implicit step of balls, each in a lane of its own.

#include <glm/geometric.hpp>

#include "softbody/integrate/implicit/attempts.h"
#include "softbody/integrate/implicit/balance.h"
#include "softbody/integrate/implicit/implicit_steps.h"
#include "softbody/mechanics/make_body_model.h"
#include "softbody/state/rigid_motion.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {

inline glm::dvec3 at(const Lanes& f, std::size_t particle, std::size_t lane) { return LaneView{f, lane}(particle); }
inline void put(Lanes& f, std::size_t particle, std::size_t lane, const glm::dvec3& value) {
  write(f, particle * implicit_lanes + lane, value);
}

/// Returns a smooth plane that throws nothing back.
inline PlaneContact plane(std::size_t particle, std::size_t lane, const glm::dvec3& normal, double min_displacement,
                          const glm::dvec3& force = glm::dvec3(0.0)) {
  return {.point = {{particle * implicit_lanes + lane}},
          .friction = 0,
          .restitution = 0,
          .normal = normal,
          .min_displacement = min_displacement,
          .force = force};
}

/// Returns a pair with the same force whatever moves.
inline LinearPenaltyPair penalty_pair(std::size_t particle, std::size_t lane, const glm::dvec3& normal,
                                      const glm::dvec3& force) {
  return {.at = particle * implicit_lanes + lane, .normal = normal, .slopes = {}, .force = force};
}

/// The balls start and end at rest in balance, at their axes' origins, until they are moved.
struct ImplicitRig {
  explicit ImplicitRig(double stiffness = 1e4, double step = 0.01, double damping_ratio = 0.1)
      : model(make_body_model({}, gas_ball(stiffness, damping_ratio))), h(step) {
    for (std::size_t lane = 0; lane < implicit_lanes; ++lane) move(lane, glm::dvec3(0.0));
    bodies.end_x = bodies.x, bodies.end_v = bodies.v;
  }
  std::size_t particles() const { return model->mesh.vertices.size(); }
  /// Starts a lane's ball with this rigid motion, so many times as large along each axis.
  void move(std::size_t lane, const glm::dvec3& velocity, const glm::dvec3& spin = glm::dvec3(0.0),
            const glm::dvec3& scale = glm::dvec3(1.0)) {
    for (std::size_t i = 0; i < particles(); ++i) {
      put(bodies.x, i, lane, scale * model->start[i]);
      put(bodies.v, i, lane, velocity + glm::cross(spin, scale * model->start[i]));
    }
  }
  /// Adds a plane with this normal before each particle of a lane, `gap` m (or its overlap) from the ball's lowest.
  void add_plane(std::size_t lane, const glm::dvec3& normal, double gap) {
    double lowest = 1e9;
    for (std::size_t i = 0; i < particles(); ++i) lowest = std::min(lowest, glm::dot(at(bodies.x, i, lane), normal));
    for (std::size_t i = 0; i < particles(); ++i)
      bodies.planes.push_back(plane(i, lane, normal, lowest - gap - glm::dot(at(bodies.x, i, lane), normal)));
  }
  /// Returns the step of the lanes that move.
  ImplicitStep step(LaneMask moving, LaneMask in_contact = {}) {
    for (const double length : {h, implicit_stage * h}) matrices.prepare(*model, length);
    return {*model, matrices.at(h), matrices.at(implicit_stage * h),
            h,      gravity,        MovingAxes(bodies.x, bodies.v, moving, h, gravity),
            solver, local,          in_contact};
  }
  RigidMotion start(std::size_t lane) const {
    return rigid_motion(particles(), LaneView{bodies.x, lane}, LaneView{bodies.v, lane});
  }
  RigidMotion end(std::size_t lane) const {
    return rigid_motion(particles(), LaneView{bodies.end_x, lane}, LaneView{bodies.end_v, lane});
  }
  /// Returns the energy (J) that a lane has gained from nowhere, 0 if it is negligible.
  double gain(std::size_t lane, bool pushed) const { return energy_gain(*model, bodies, lane, gravity, pushed); }

  std::shared_ptr<const BodyModel> model;
  double h;  // s
  glm::dvec3 gravity{0.0};
  ImplicitMatrices matrices;
  ImplicitBodies bodies{*model};
  QuasiNewton solver{*model};
  ImplicitStart local;
};

/// Returns a mask of these lanes.
inline LaneMask mask(std::initializer_list<std::size_t> which) {
  LaneMask m;
  for (const std::size_t lane : which) m.set(lane);
  return m;
}

}  // namespace softbody::test
