#pragma once
// The arithmetic of the kernels, for one vector of bodies at a time. Included where it is compiled for an instruction
// set.

#include <algorithm>

#include "softbody/kernels.h"
#include "softbody/solid_law.h"

namespace softbody::body {

template <class Real>
SB_INLINE Lane<Real> load(const Real* p) {
  Lane<Real> v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

template <class Real>
SB_INLINE void store(Real* p, Lane<Real> v) {
  std::memcpy(p, &v, sizeof v);
}

SB_INLINE DoubleLane load(const double* p) {
  DoubleLane v;
  std::memcpy(&v.lo, p, sizeof v.lo);
  std::memcpy(&v.hi, p + lanes / 2, sizeof v.hi);
  return v;
}

SB_INLINE void store(double* p, const DoubleLane& v) {
  std::memcpy(p, &v.lo, sizeof v.lo);
  std::memcpy(p + lanes / 2, &v.hi, sizeof v.hi);
}

template <class Real>
SB_INLINE Vec<Lane<Real>> load(Field<const Real> f, std::size_t at) {
  return {load(f.x + at), load(f.y + at), load(f.z + at)};
}

template <class Real>
SB_INLINE Vec<Lane<Real>> load(Field<Real> f, std::size_t at) {
  return {load(f.x + at), load(f.y + at), load(f.z + at)};
}

template <class Real>
SB_INLINE void store(Field<Real> f, std::size_t at, Vec<Lane<Real>> v) {
  store(f.x + at, v.x);
  store(f.y + at, v.y);
  store(f.z + at, v.z);
}

SB_INLINE Vec<Lane<float>> load(const LaneVector& v) { return {load(v.x), load(v.y), load(v.z)}; }

/// Hooke's spring with a damper along it: f = (k (L - L0) + c (dv . dx) / L) dx / L on i, minus that on j.
/// A spring of length zero has no direction and pulls nowhere.
template <class Real>
SB_INLINE void springs(std::span<const KernelSpring<Real>> list, Field<const Real> x, Field<const Real> v,
                       Field<Real> f) {
  using V = Lane<Real>;
  const V tiny = V{} + Real(1e-12);  // m; its inverse times any stiffness is finite, so that times dx = 0 it is 0
  for (const KernelSpring<Real>& s : list) {
    const Vec<V> dx = load(x, s.j) - load(x, s.i), dv = load(v, s.j) - load(v, s.i);
    const V length = square_root(dot(dx, dx));
    const V inverse = Real(1) / larger(length, tiny);
    const V tension = s.stiffness * (length - s.rest) + s.damping * (dot(dv, dx) * inverse);
    const Vec<V> force = (tension * inverse) * dx;
    store(f, s.i, load(f, s.i) + force);
    store(f, s.j, load(f, s.j) - force);
  }
}

/// XPBD, one pass without accumulated multipliers (Macklin et al. 2016, eq. 18 and 26 times the stiffness): the spring
/// as a constraint of compliance 1 / k with its damper. Particles are at x + d, d their displacements in this step:
/// these are small, so that floats leave velocities their digits.
SB_INLINE void project_springs(const ProjectArguments& p, std::span<const KernelSpring<float>> list,
                               Field<const float> x, Field<float> d) {
  using V = Lane<float>;
  const V tiny = V{} + 1e-12f;  // m
  const V inverse_mass = p.inverse_mass * load(p.moves);
  const float inverse_h = 1 / p.h, inverse_h2 = inverse_h * inverse_h;
  for (const KernelSpring<float>& s : list) {
    const Vec<V> di = load(d, s.i), dj = load(d, s.j), moved = dj - di;
    const Vec<V> dx = (load(x, s.j) - load(x, s.i)) + moved;
    const V length = square_root(dot(dx, dx));
    const Vec<V> n = (1.0f / larger(length, tiny)) * dx;
    const float damping = s.damping * inverse_h;
    const float yields = 1 / ((s.stiffness + damping) * 2 * p.inverse_mass + inverse_h2);
    const V impulse = yields * (s.stiffness * (length - s.rest) + damping * dot(moved, n));
    const Vec<V> shift = (inverse_mass * impulse) * n;
    store(d, s.i, di + shift);
    store(d, s.j, dj - shift);
  }
}

/// Signed volume by the divergence theorem: the sum of a . (b x c) / 6 over the faces, seen from one of the corners and
/// added up in blocks, for the gas of a body at rest breathes with its last digits.
template <class Real>
SB_INLINE void volume(std::span<const KernelTriangle> faces, Field<const Real> x, Real* result) {
  using V = Lane<Real>;
  constexpr std::size_t block = 16;
  const Vec<V> from = faces.empty() ? Vec<V>{} : load(x, faces[0][0]);
  V six{};
  for (std::size_t first = 0; first < faces.size(); first += block) {
    V part{};
    for (const auto& [a, b, c] : faces.subspan(first, std::min(block, faces.size() - first)))
      part += dot(load(x, a) - from, cross(load(x, b) - from, load(x, c) - from));
    six += part;
  }
  store(result, six / Real(6));
}

/// What the stability bound needs, see Surface: the sum of |c|^2, c = (b - a) x (c - a), and the largest perimeter.
SB_INLINE void surface(std::span<const KernelTriangle> faces, Field<const float> x, float* cross_square_sum,
                       float* perimeter) {
  using V = Lane<float>;
  V sum{}, longest{};
  for (const auto& [a, b, c] : faces) {
    const Vec<V> ab = load(x, b) - load(x, a), ac = load(x, c) - load(x, a), bc = ac - ab;
    const Vec<V> cross_product = cross(ab, ac);
    sum += dot(cross_product, cross_product);
    longest = larger(square_root(dot(ab, ab)) + square_root(dot(ac, ac)) + square_root(dot(bc, bc)), longest);
  }
  store(cross_square_sum, sum);
  store(perimeter, longest);
}

/// A third of each face's pressure force to each of its corners (Matyka & Ollila 2003).
template <class Real>
SB_INLINE void pressure(std::span<const KernelTriangle> faces, Field<const Real> x, const Real* gauge, Field<Real> f) {
  using V = Lane<Real>;
  const V sixth = load(gauge) / Real(6);
  for (const auto& [a, b, c] : faces) {
    const Vec<V> pa = load(x, a);
    const Vec<V> third = sixth * cross(load(x, b) - pa, load(x, c) - pa);
    store(f, a, load(f, a) + third);
    store(f, b, load(f, b) + third);
    store(f, c, load(f, c) + third);
  }
}

/// What the fit of the shape needs. Seen from one of the particles and added up in blocks, as volume() is.
template <class Real>
SB_INLINE void shape_moments(std::span<const ShapePoint<Real>> shape, Field<const Real> x, ShapeMoments<Real>& m) {
  using V = Lane<Real>;
  constexpr std::size_t block = 16;
  const Vec<V> from = load(x, 0);
  Vec<V> sum{}, covariance[3]{};
  for (std::size_t first = 0; first < shape.size(); first += block) {
    Vec<V> part{}, a{}, b{}, c{};
    for (std::size_t i = first; i < std::min(first + block, shape.size()); ++i) {
      const Vec<V> d = load(x, i * lanes) - from;
      part = part + d;
      a = a + (V{} + shape[i].x) * d;
      b = b + (V{} + shape[i].y) * d;
      c = c + (V{} + shape[i].z) * d;
    }
    sum = sum + part;
    covariance[0] = covariance[0] + a;
    covariance[1] = covariance[1] + b;
    covariance[2] = covariance[2] + c;
  }
  const V share = V{} + Real(1) / static_cast<Real>(shape.size());
  store(Field<Real>{m.mean[0], m.mean[1], m.mean[2]}, 0, from + share * sum);
  for (int k = 0; k < 3; ++k)
    store(Field<Real>{m.covariance[3 * k], m.covariance[3 * k + 1], m.covariance[3 * k + 2]}, 0, covariance[k]);
}

/// Draws each particle to its place: f += stiffness (centre + R q - x).
template <class Real>
SB_INLINE void shape_pull(std::span<const ShapePoint<Real>> shape, const ShapePose<Real>& pose, Real stiffness,
                          Field<const Real> x, Field<Real> f) {
  using V = Lane<Real>;
  const Vec<V> centre{load(pose.centre[0]), load(pose.centre[1]), load(pose.centre[2])};
  Vec<V> column[3];
  for (int k = 0; k < 3; ++k)
    column[k] = {load(pose.rotation[3 * k]), load(pose.rotation[3 * k + 1]), load(pose.rotation[3 * k + 2])};
  const V pull = V{} + stiffness;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Vec<V> goal =
        centre + (V{} + shape[i].x) * column[0] + (V{} + shape[i].y) * column[1] + (V{} + shape[i].z) * column[2];
    store(f, i * lanes, load(f, i * lanes) + pull * (goal - load(x, i * lanes)));
  }
}

SB_INLINE void kick(const KickArguments& k, Field<const float> f, Field<float> v) {
  using V = Lane<float>;
  const V moves = load(k.moves);
  const V scale = k.h_over_mass * moves;
  const Vec<V> g{k.gx * moves, k.gy * moves, k.gz * moves};
  for (std::size_t at = 0; at < k.particles * lanes; at += lanes) store(v, at, load(v, at) + scale * load(f, at) + g);
}

SB_INLINE void drift(std::size_t particles, float h, const float* moves, Field<const float> v, Field<float> x) {
  const Lane<float> step = h * load(moves);
  for (std::size_t at = 0; at < particles * lanes; at += lanes) store(x, at, load(x, at) + step * load(v, at));
}

/// Returns the lanes in which the solid acted, as bits.
template <class Shape>
SB_INLINE unsigned solid(const SolidArguments& s, const Shape& shape, Field<const float> x, Field<float> v) {
  using V = Lane<float>;
  const V zero{};
  const Vec<V> place = load(s.place);
  Vec<V> impulse = load(s.impulse, 0);
  V most{}, returned = load(s.returned);
  for (std::size_t at = 0; at < s.particles * lanes; at += lanes) {
    const SurfaceAt<V> surface = surface_at(shape, load(x, at) - place);
    Vec<V> velocity = load(v, at);
    const Vec<V> before = s.restitution > 0 ? load(s.before, at) : Vec<V>{};
    const V change = respond(s, load(s.moves), surface.distance, surface.normal, before, velocity);
    impulse = impulse + (s.mass * change) * surface.normal;
    returned += s.restitution * s.mass * change;
    most = larger(change, most);
    store(v, at, velocity);
  }
  store(s.impulse, 0, impulse);
  store(s.returned, returned);
  unsigned acted = 0;
  for (int l = 0; l < lanes; ++l) acted |= unsigned(most[l] > zero[l]) << l;
  return acted;
}

SB_INLINE unsigned solid(const SolidArguments& s, Field<const float> x, Field<float> v) {
  if (const auto* sphere = std::get_if<SphereShape<float>>(&s.shape)) return solid(s, *sphere, x, v);
  if (const auto* plane = std::get_if<PlaneShape<float>>(&s.shape)) return solid(s, *plane, x, v);
  if (const auto* box = std::get_if<BoxShape<float>>(&s.shape)) return solid(s, *box, x, v);
  return solid(s, std::get<CapsuleShape<float>>(s.shape), x, v);
}

SB_INLINE void extent(std::size_t particles, Field<const float> x, Field<const float> v, Extent& e) {
  using V = Lane<float>;
  Vec<V> lo = load(x, 0), hi = lo;
  V speed2{};
  for (std::size_t at = 0; at < particles * lanes; at += lanes) {
    const Vec<V> p = load(x, at), u = load(v, at);
    lo = {smaller(p.x, lo.x), smaller(p.y, lo.y), smaller(p.z, lo.z)};
    hi = {larger(p.x, hi.x), larger(p.y, hi.y), larger(p.z, hi.z)};
    speed2 = larger(dot(u, u), speed2);
  }
  store(Field<float>{e.lo.x, e.lo.y, e.lo.z}, 0, lo);
  store(Field<float>{e.hi.x, e.hi.y, e.hi.z}, 0, hi);
  store(e.speed2, speed2);
}

}  // namespace softbody::body
