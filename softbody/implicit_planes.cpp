#include "softbody/implicit_planes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/rigid_motion.h"

namespace softbody {

namespace {

/// m, by which a particle's end is short of what its plane needs.
double missing(const ImplicitWork& work, const PlaneContact& c) {
  const std::size_t stride = work.x.size() / 3;
  double along = 0;
  for (std::size_t k = 0; k < 3; ++k)
    along += (work.end_x[c.at + k * stride] - work.x[c.at + k * stride]) * c.normal[int(k)];
  return c.need - along;
}

}  // namespace

std::array<bool, lanes> behind_planes(const ImplicitWork& work) {
  std::array<bool, lanes> behind{};
  for (const PlaneContact& c : work.planes) behind[c.at % lanes] = behind[c.at % lanes] || missing(work, c) > 0;
  return behind;
}

void clear_planes(ImplicitWork& work, double h) {
  const std::size_t stride = work.x.size() / 3;
  bool any = true;
  for (int pass = 0; any && pass < plane_passes; ++pass) {
    any = false;
    for (const PlaneContact& c : work.planes) {
      const double by = missing(work, c);
      if (!(by > 0)) continue;
      any = true;
      for (std::size_t k = 0; k < 3; ++k) {
        work.end_x[c.at + k * stride] += by * c.normal[int(k)];
        work.end_v[c.at + k * stride] += by / h * c.normal[int(k)];
      }
    }
  }
}

bool keeps_balance(const Prototype& p, const ImplicitWork& work, std::size_t lane, double h,
                   const glm::dvec3& gravity) {
  constexpr double share = 0.1;
  const std::size_t stride = work.x.size() / 3;
  const auto read = [&](const Lanes& f, std::size_t at) {
    return glm::dvec3(f[at], f[at + stride], f[at + 2 * stride]);
  };
  glm::dvec3 gained(0.0), given(0.0);
  for (std::size_t at = lane; at < stride; at += lanes)
    gained += p.particle_mass * (read(work.end_v, at) - read(work.v, at) - h * gravity);
  for (const PlaneContact& c : work.planes)
    if (c.at % lanes == lane) given += h * c.force;
  for (const LinearShield& s : work.shields)
    if (s.at % lanes == lane) given += h * s.after(read(work.end_x, s.at) - read(work.x, s.at));
  return glm::distance(gained, given) <=
         share * (glm::length(given) + h * p.material.mass * glm::length(gravity)) + 1e-6 * p.material.mass;
}

void go_on_as_one(ImplicitWork& work, std::size_t lane, double h, const glm::dvec3& gravity) {
  const std::size_t stride = work.x.size() / 3, particles = stride / lanes;
  const auto field = [&](const Lanes& f) {
    return [&f, lane, stride](std::size_t i) {
      const std::size_t at = i * lanes + lane;
      return glm::dvec3(f[at], f[at + stride], f[at + 2 * stride]);
    };
  };
  const auto x = field(work.x), v = field(work.v);
  const RigidMotion m = rigid_motion(particles, x, v);
  // With a share of its spin: how much of the energy of that is more than the body has, as a part of it.
  const auto move = [&](double share) {
    const glm::dmat3 turned = rotation(share * h * m.spin);
    const glm::dvec3 spin = share * (turned * m.spin_of(glm::transpose(turned) * m.momentum));
    const auto aside = [&](std::size_t i) { return turned * (x(i) - m.centre) - (x(i) - m.centre); };
    const glm::dvec3 shift = stopped(work.planes, lane, h, h * (m.velocity + h * gravity), aside);
    double gain = -2 * glm::dot(gravity, shift) * double(particles), before = 0, spinning = 0;
    for (std::size_t i = 0; i < particles; ++i) {
      const glm::dvec3 place = x(i) + aside(i) + shift, round = glm::cross(spin, turned * (x(i) - m.centre)),
                       velocity = shift / h + round;
      gain += glm::dot(velocity, velocity);
      before += glm::dot(v(i), v(i));
      spinning += glm::dot(round, round);
      for (std::size_t k = 0; k < 3; ++k) {
        work.end_x[i * lanes + lane + k * stride] = place[int(k)];
        work.end_v[i * lanes + lane + k * stride] = velocity[int(k)];
      }
    }
    constexpr double rounding = 1e-9;
    return gain - before <= rounding * before ? 0 : (gain - before) / spinning;
  };
  if (const double excess = move(1); excess > 0 && !(excess < 1 && move(std::sqrt(1 - excess)) <= 0)) move(0);
  for (PlaneContact& c : work.planes)
    if (c.at % lanes == lane) c.force = glm::dvec3(0.0);
}

}  // namespace softbody
