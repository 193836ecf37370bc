#include "softbody/integrate/implicit/moving_axes.h"

namespace softbody {

MovingAxes::MovingAxes(const Lanes& x, const Lanes& v, LaneMask which, double h, const glm::dvec3& gravity)
    : active_(which), h_(h), gravity_(gravity), fall_(h * h * gravity) {
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!which[l]) continue;
    const RigidMotion body = rigid_motion(x.size() / (3 * implicit_lanes), LaneView{x, l}, LaneView{v, l});
    const glm::dvec3 spin = body.steady_spin_of(body.momentum);  // any axes serve that do not jump about
    axes_[l] = {body, spin, rotation(h * spin)};
  }
}

MovingAxes MovingAxes::subset(LaneMask which) const {
  MovingAxes result = *this;
  result.active_ &= which;
  for (std::size_t l = 0; l < implicit_lanes; ++l)
    if (!which[l]) result.axes_[l] = {};
  return result;
}

glm::dvec3 MovingAxes::free_displacement(std::size_t lane, const glm::dvec3& x, const glm::dvec3& v) const {
  const Axes& f = axes_[lane];
  const glm::dvec3 out = x - f.body.centre, own = v - glm::cross(f.spin, out) - f.body.velocity;
  return h_ * f.body.velocity + fall_ + (f.turned * out - out) + f.turned * (h_ * own);
}

/// Calls change(axes, x, v, at) for each particle of the lanes that have axes of their own.
template <class Change>
void MovingAxes::for_each(Lanes& x, Lanes& v, const Change& change) const {
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!active_[l]) continue;
    for (std::size_t at = l; at < x.size() / 3; at += implicit_lanes) {
      glm::dvec3 place = read(x, at), velocity = read(v, at);
      change(axes_[l], place, velocity, at);
      write(x, at, place);
      write(v, at, velocity);
    }
  }
}

void MovingAxes::enter(const Lanes& x, const Lanes& v, ImplicitStart& start, std::span<const HeldEnd> held) const {
  for (std::size_t l = 0; l < implicit_lanes; ++l) start.moves[l] = active_[l] ? 1.0f : 0.0f;
  start.x = x;
  start.v = v;
  start.a.resize(x.size());
  start.carried.assign(x.size(), 0.0);
  start.held.clear();
  for (const auto& [at, place] : held) {
    const Axes& f = axes_[at % implicit_lanes];
    if (active_[at % implicit_lanes])
      start.held.push_back({at, glm::transpose(f.turned) * (place - f.body.centre - h_ * f.body.velocity - fall_)});
  }
  for_each(start.x, start.v, [&](const Axes& f, glm::dvec3& place, glm::dvec3& velocity, std::size_t at) {
    place -= f.body.centre;
    velocity -= f.body.velocity + glm::cross(f.spin, place);
    write(start.carried, at, place - glm::transpose(f.turned) * (place - h_ * f.body.velocity - fall_));
  });
  accelerations(start.x, start.v, start.a);
}

PlaneContact MovingAxes::enter(const PlaneContact& contact) const {
  PlaneContact c = contact;
  c.normal = enter(c.point.lane(), c.normal);
  return c;
}

LinearPenaltyPair MovingAxes::enter(const LinearPenaltyPair& pair) const {
  LinearPenaltyPair s = pair;
  for (glm::dvec3* v : {&s.normal, &s.force, &s.partner, &s.start_separation}) *v = enter(s.at % implicit_lanes, *v);
  return s;
}

void MovingAxes::accelerations(const Lanes& x, const Lanes& v, Lanes& a) const {
  const std::size_t stride = a.size() / 3;
  for (std::size_t k = 0; k < 3; ++k)
    std::fill(a.begin() + std::ptrdiff_t(k * stride), a.begin() + std::ptrdiff_t((k + 1) * stride), gravity_[int(k)]);
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    const glm::dvec3 spin = axes_[l].spin;
    if (!active_[l]) continue;
    for (std::size_t at = l; at < stride; at += implicit_lanes)
      write(a, at, -glm::cross(spin, glm::cross(spin, read(x, at)) + 2.0 * read(v, at)));
  }
}

void MovingAxes::leave(Lanes& x, Lanes& v) const {
  std::array<glm::dvec3, implicit_lanes> middle{};
  for_each(x, v, [&](const Axes&, glm::dvec3& place, glm::dvec3&, std::size_t at) {
    middle[at % implicit_lanes] += place / double(x.size() / (3 * implicit_lanes));
  });
  for_each(x, v, [&](const Axes& f, glm::dvec3& place, glm::dvec3& velocity, std::size_t at) {
    // What pushes the body has set the velocity of its middle, in the world's directions: the axes' spin adds none.
    velocity += glm::cross(f.spin, place - middle[at % implicit_lanes]);
    velocity = f.body.velocity + h_ * gravity_ + f.turned * velocity;
    place = f.body.centre + h_ * f.body.velocity + fall_ + f.turned * place;
  });
}

}  // namespace softbody
