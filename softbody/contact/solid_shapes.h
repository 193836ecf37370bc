// The signed distance of a point from each shape of a solid, with the surface's outward normal nearest to it. Written
// once for the kernels (V is one value a lane, Real is float) and for plain doubles. All shapes are convex: the whole
// solid lies behind the plane through the nearest point of its surface, so a particle that stays before this plane for
// a step passes through no solid, however thin it is and however fast the particle. Compiled for each of Highway's
// targets, see state/simd.h.
#if defined(SOFTBODY_CONTACT_SOLID_SHAPES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_CONTACT_SOLID_SHAPES_H
#undef SOFTBODY_CONTACT_SOLID_SHAPES_H
#else
#define SOFTBODY_CONTACT_SOLID_SHAPES_H
#endif

#include "softbody/contact/solid_geometry.h"
#include "softbody/state/simd.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {

template <class V>
struct SurfaceAt {
  V distance;           // m, negative inside
  simd::Vec<V> normal;  // unit, out of the solid
};

namespace simd {

/// Returns the surface of a sphere as seen from d; at its very centre out is up.
template <class Real, class V>
HWY_INLINE SurfaceAt<V> surface_at(const SphereShape<Real>& s, Vec<V> d) {
  const V tiny(Real(1e-12));  // m
  const V distance = square_root(dot(d, d));
  Vec<V> n = (Real(1) / larger(distance, tiny)) * d;
  n.y = select(distance > tiny, n.y, V(1));
  return {distance - s.radius, n};
}

template <class Real, class V>
HWY_INLINE SurfaceAt<V> surface_at(const PlaneShape<Real>& p, Vec<V> d) {
  const Vec<V> n{V(p.normal.x), V(p.normal.y), V(p.normal.z)};
  return {dot(d, n), n};
}

/// Returns the distance to the nearest point of the box, or inside it to the nearest face, less the radius.
template <class Real, class V>
HWY_INLINE SurfaceAt<V> surface_at(const BoxShape<Real>& b, Vec<V> d) {
  const V zero{}, one(1), tiny(Real(1e-12));  // m
  const auto& [x, y, z] = b.axes;
  const Vec<V> q{x.x * d.x + x.y * d.y + x.z * d.z, y.x * d.x + y.y * d.y + y.z * d.z,
                 z.x * d.x + z.y * d.y + z.z * d.z};  // along the box's axes
  const Vec<V> a{larger(q.x, -q.x) - b.half_size.x, larger(q.y, -q.y) - b.half_size.y,
                 larger(q.z, -q.z) - b.half_size.z};  // beyond each pair of faces
  const Vec<V> beyond{larger(a.x, zero), larger(a.y, zero), larger(a.z, zero)};
  const V outside = square_root(dot(beyond, beyond));
  const V inverse = Real(1) / larger(outside, tiny);
  const V face_x = select(a.x >= larger(a.y, a.z), one, zero);
  const V face_y = select(a.y >= a.z, one - face_x, zero), face_z = one - face_x - face_y;
  Vec<V> n = select(outside > tiny, inverse * beyond, Vec<V>{face_x, face_y, face_z});
  n = {select(q.x < zero, -n.x, n.x), select(q.y < zero, -n.y, n.y), select(q.z < zero, -n.z, n.z)};
  return {select(outside > tiny, outside, larger(a.x, larger(a.y, a.z))) - b.radius,
          {n.x * x.x + n.y * y.x + n.z * z.x, n.x * x.y + n.y * y.y + n.z * z.y, n.x * x.z + n.y * y.z + n.z * z.z}};
}

/// Returns the surface of the sphere round the nearest point of the segment.
template <class Real, class V>
HWY_INLINE SurfaceAt<V> surface_at(const CapsuleShape<Real>& c, Vec<V> d) {
  const V zero{};
  const Vec<V> segment{V(c.segment.x), V(c.segment.y), V(c.segment.z)};
  const V square = dot(segment, segment);
  const V along = select(square > zero, dot(d, segment) / square, zero);
  return surface_at(SphereShape<Real>{c.radius}, d - smaller(larger(along, zero), V(1)) * segment);
}

template <std::floating_point Real, std::floating_point V>
HWY_INLINE SurfaceAt<V> surface_at(const SolidShape<Real>& shape, Vec<V> d) {
  return std::visit([d](const auto& one) { return surface_at(one, d); }, shape);
}

}  // namespace simd
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
