#pragma once
// What solids do to particles, for `width` bodies at a time. Included where it is compiled for an instruction set.

#include <variant>

#include "softbody/contact/solid_law.h"
#include "softbody/state/kernel_bodies.h"

namespace softbody::body {

/// Whether respond() may act in any lane, told without a root or a quotient where that is possible.
template <class V, class Shape>
SB_INLINE bool may_act(const SolidArguments&, const Shape&, const Vec<V>&, const Vec<V>&) {
  return true;
}

/// With the distance r from the centre of a sphere of radius R, what is outside comes nearer than the surface only if
/// -h d.v > r (r - R), which is at least (r^2 - R^2) / 2. What is inside and is not left alone satisfies that, too.
template <class V>
SB_INLINE bool may_act(const SolidArguments& s, const SphereShape<float>& sphere, const Vec<V>& d, const Vec<V>& v) {
  constexpr float rounding = 4e-6f;
  const V square = dot(d, d);
  return any_above((-2 * s.h) * dot(d, v), (square - sphere.radius * sphere.radius) - rounding * square);
}

/// Returns the lanes in which the solid acted, as bits.
template <int width, class Shape>
SB_INLINE unsigned solid(const SolidArguments& s, const Shape& shape, Field<const float> x, Field<float> v) {
  using V = Lane<float, width>;
  const V zero{};
  const Vec<V> place = load<V>(s.place);
  Vec<V> impulse = load<V>(s.impulse, 0);
  V most{}, returned = load<V>(s.returned);
  for (std::size_t at = 0; at < s.particles * width; at += width) {
    const Vec<V> d = load<V>(x, at) - place;
    Vec<V> velocity = load<V>(v, at);
    if (!may_act(s, shape, d, velocity)) continue;
    const SurfaceAt<V> surface = surface_at(shape, d);
    const Vec<V> before = s.restitution > 0 ? load<V>(s.before, at) : Vec<V>{};
    const V change = respond(s, load<V>(s.moves), surface.distance, surface.normal, before, velocity);
    if (!any_above(change, zero)) continue;
    impulse = impulse + (s.mass * change) * surface.normal;
    returned += s.restitution * s.mass * change;
    most = larger(change, most);
    store(v, at, velocity);
  }
  store(s.impulse, 0, impulse);
  store(s.returned, returned);
  return lanes_above(most, zero);
}

template <int width>
SB_INLINE unsigned solid(const SolidArguments& s, Field<const float> x, Field<float> v) {
  if (const auto* sphere = std::get_if<SphereShape<float>>(&s.shape)) return solid<width>(s, *sphere, x, v);
  if (const auto* plane = std::get_if<PlaneShape<float>>(&s.shape)) return solid<width>(s, *plane, x, v);
  if (const auto* box = std::get_if<BoxShape<float>>(&s.shape)) return solid<width>(s, *box, x, v);
  return solid<width>(s, std::get<CapsuleShape<float>>(s.shape), x, v);
}

}  // namespace softbody::body
