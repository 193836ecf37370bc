#include "softbody/contact/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "softbody/contact/kernels.cpp"
#include <hwy/foreach_target.h>

#include "softbody/contact/solid_law.h"
#include "softbody/contact/solid_shapes.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace {

using namespace simd;

/// Returns true if respond() may act in any lane, without a root or a quotient where that is possible.
template <class V, class Shape>
HWY_INLINE bool may_act(const SolidArguments&, const Shape&, const Vec<V>&, const Vec<V>&) {
  return true;
}

/// With the distance r from the centre of a sphere of radius R, what is outside comes nearer than the surface only if
/// -h d.v > r (r - R), which is at least (r^2 - R^2) / 2. What is inside and is not left alone satisfies that, too.
template <class V>
HWY_INLINE bool may_act(const SolidArguments& s, const SphereShape<float>& sphere, const Vec<V>& d, const Vec<V>& v) {
  constexpr float rounding = 4e-6f;
  const V square = dot(d, d);
  return any_above((-2 * s.h) * dot(d, v), (square - sphere.radius * sphere.radius) - rounding * square);
}

/// Returns the lanes in which the solid acted, as bits.
template <int width, class Shape>
unsigned act_by(const Shape& shape, std::size_t used, const SolidArguments& s, Field<const float> x, Field<float> v) {
  using V = Run<float, width>;
  const V zero{};
  unsigned acted = 0;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const V moves = select_bits(s.near >> first, load<V>(s.moves + first));
    if (!any_above(moves, zero)) continue;
    const Vec<V> place{load<V>(s.place.x + first), load<V>(s.place.y + first), load<V>(s.place.z + first)};
    Vec<V> impulse = load<V>(s.sums.impulse, first);
    V most{}, energy{}, returned{};
    for (std::size_t at = first; at < s.particles * width; at += width) {
      const Vec<V> d = load<V>(x, at) - place;
      Vec<V> velocity = load<V>(v, at);
      if (!may_act(s, shape, d, velocity)) continue;
      const SurfaceAt<V> surface = surface_at(shape, d);
      const Vec<V> before = s.restitution > 0 ? load<V>(s.before, at) : Vec<V>{};
      const V change = respond(s, moves, surface.distance, surface.normal, before, velocity, energy, returned);
      if (!any_above(change, zero)) continue;
      impulse = impulse + (s.mass * change) * surface.normal;
      most = larger(change, most);
      store(v, at, velocity);
    }
    store(s.sums.impulse, first, impulse);
    store(s.sums.returned + first, load<V>(s.sums.returned + first) + s.mass * returned);
    store(s.sums.energy + first, load<V>(s.sums.energy + first) + s.mass * energy);
    acted |= lanes_above(most, zero) << first;
  }
  return acted;
}

unsigned ActBySolid(int width, std::size_t used, const SolidArguments& s, Field<const float> x, Field<float> v) {
  return std::visit(
      [&](const auto& shape) { return with_width(width, [&](auto w) { return act_by<w>(shape, used, s, x, v); }); },
      s.shape);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(ActBySolid);

unsigned act_by_solid(int width, std::size_t used, const SolidArguments& solid, Field<const float> x, Field<float> v) {
  return HWY_DYNAMIC_DISPATCH(ActBySolid)(width, used, solid, x, v);
}

}  // namespace softbody
#endif  // HWY_ONCE
