#include "softbody/implicit_frames.h"

namespace softbody {
namespace {

glm::dvec3 read(const Lanes& f, std::size_t at) {
  const std::size_t stride = f.size() / 3;
  return {f[at], f[at + stride], f[at + 2 * stride]};
}
void write(Lanes& f, std::size_t at, const glm::dvec3& value) {
  const std::size_t stride = f.size() / 3;
  for (std::size_t k = 0; k < 3; ++k) f[at + k * stride] = value[int(k)];
}

}  // namespace

ImplicitFrames::ImplicitFrames(const Lanes& x, const Lanes& v, const std::array<bool, lanes>& which,
                               const glm::dvec3& gravity)
    : which_(which), gravity_(gravity) {
  for (std::size_t l = 0; l < lanes; ++l)
    if (which[l])
      start_[l] = rigid_motion(
          x.size() / (3 * lanes), [&](std::size_t i) { return read(x, i * lanes + l); },
          [&](std::size_t i) { return read(v, i * lanes + l); });
}

/// change(l, x, v): of one particle of a lane that has a frame of its own.
template <class Change>
void ImplicitFrames::for_each(Lanes& x, Lanes& v, const Change& change) const {
  for (std::size_t l = 0; l < lanes; ++l) {
    if (!which_[l]) continue;
    for (std::size_t at = l; at < x.size() / 3; at += lanes) {
      glm::dvec3 place = read(x, at), velocity = read(v, at);
      change(l, place, velocity);
      write(x, at, place);
      write(v, at, velocity);
    }
  }
}

void ImplicitFrames::enter(Lanes& x, Lanes& v) const {
  for_each(x, v, [this](std::size_t l, glm::dvec3& place, glm::dvec3& velocity) {
    place -= start_[l].centre;
    velocity -= start_[l].velocity + glm::cross(start_[l].spin, place);
  });
}

void ImplicitFrames::leave(double h, Lanes& x, Lanes& v) const {
  std::array<glm::dmat3, lanes> turned;
  for (std::size_t l = 0; l < lanes; ++l) turned[l] = rotation(h * start_[l].spin);
  for_each(x, v, [&](std::size_t l, glm::dvec3& place, glm::dvec3& velocity) {
    const RigidMotion& m = start_[l];
    velocity = m.velocity + h * gravity_ + turned[l] * (velocity + glm::cross(m.spin, place));
    place = m.centre + h * m.velocity + h * h / 2 * gravity_ + turned[l] * place;
  });
}

void ImplicitFrames::accelerations(const Lanes& x, const Lanes& v, Lanes& a) const {
  for (std::size_t k = 0; k < 3; ++k)
    std::fill_n(a.begin() + std::ptrdiff_t(k * a.size() / 3), a.size() / 3, gravity_[int(k)]);
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::dvec3 spin = start_[l].spin;
    if (!which_[l]) continue;
    for (std::size_t at = l; at < x.size() / 3; at += lanes)
      write(a, at, -glm::cross(spin, glm::cross(spin, read(x, at)) + 2.0 * read(v, at)));
  }
}

}  // namespace softbody
