#include "app/reference/body_shape.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/state/best_rotation.h"

namespace app::reference {
namespace {

glm::dvec3 mean(const std::vector<glm::dvec3>& list) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : list) sum += p - list.front();  // small numbers: no digits are lost a kilometre away
  return list.front() + sum / double(list.size());
}

}  // namespace

double rms_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  assert(a.size() == b.size() && !a.empty());
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

double shape_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  assert(a.size() == b.size() && !a.empty());
  const glm::dvec3 centre_a = mean(a), centre_b = mean(b);
  glm::dmat3 covariance(0.0);
  for (std::size_t i = 0; i < a.size(); ++i) covariance += glm::outerProduct(a[i] - centre_a, b[i] - centre_b);
  const glm::dmat3 rotation = softbody::best_rotation(covariance);
  std::vector<glm::dvec3> fitted;
  for (const glm::dvec3& p : b) fitted.push_back(centre_a + rotation * (p - centre_b));
  return rms_distance(a, fitted);
}

double volume_of(const std::vector<glm::dvec3>& x, const std::vector<softbody::Triangle>& triangles) {
  assert(!x.empty());
  std::vector<glm::dvec3> near;  // softbody::volume() loses digits far from the origin
  for (const glm::dvec3& p : x) near.push_back(p - x.front());
  return softbody::volume(near, triangles);
}

RigidMotion rigid_motion(const BodyState& s) {
  assert(s.x.size() == s.v.size() && !s.x.empty());
  RigidMotion m{.centre = mean(s.x), .velocity = mean(s.v)};
  const double share = 1 / double(s.x.size());
  glm::dmat3 inertia(0.0);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const glm::dvec3 r = s.x[i] - m.centre;
    m.momentum += share * glm::cross(r, s.v[i] - m.velocity);
    inertia += share * (glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r));
  }
  const double scale = inertia[0][0] + inertia[1][1] + inertia[2][2];
  if (glm::determinant(inertia) > 1e-12 * scale * scale * scale) m.spin = glm::inverse(inertia) * m.momentum;
  return m;
}

double deformation_speed(const BodyState& s) {
  const RigidMotion m = rigid_motion(s);
  double sum = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const glm::dvec3 own = s.v[i] - m.velocity - glm::cross(m.spin, s.x[i] - m.centre);
    sum += glm::dot(own, own);
  }
  return std::sqrt(sum / double(s.x.size()));
}

}  // namespace app::reference
