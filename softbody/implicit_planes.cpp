#include "softbody/implicit_planes.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace softbody {

namespace {

constexpr int most_passes = 8;  // over planes that stand in each other's way

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
  for (int pass = 0; any && pass < most_passes; ++pass) {
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

void stop_as_one(ImplicitWork& work, std::size_t lane, double h, const glm::dvec3& gravity) {
  constexpr double push_out = 1;  // m/s, of solids
  const std::size_t stride = work.x.size() / 3, particles = stride / lanes;
  glm::dvec3 shift = h * h * gravity;
  for (std::size_t i = 0; i < particles; ++i)
    for (std::size_t k = 0; k < 3; ++k) shift[int(k)] += h * work.v[i * lanes + lane + k * stride] / double(particles);
  const double reach = glm::length(shift) + h * push_out;
  for (int pass = 0; pass < most_passes; ++pass)
    for (const PlaneContact& c : work.planes)
      if (c.at % lanes == lane) shift += std::max(0.0, c.need - glm::dot(shift, c.normal)) * c.normal;
  // Planes that face each other have no place for it.
  if (const double length = glm::length(shift); length > reach) shift *= reach / length;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t at = lane + k * stride; at < (k + 1) * stride; at += lanes) {
      work.end_x[at] = work.x[at] + shift[int(k)];
      work.end_v[at] = shift[int(k)] / h;
    }
  for (PlaneContact& c : work.planes)
    if (c.at % lanes == lane) c.force = glm::dvec3(0.0);
}

}  // namespace softbody
