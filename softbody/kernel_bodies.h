#pragma once
// The arithmetic of the kernels, for `width` bodies at a time: eight, or one by itself. Included where it is compiled
// for an instruction set.

#include <algorithm>

#include "softbody/kernels.h"
#include "softbody/solid_law.h"

namespace softbody::body {

/// V: one value a lane.
template <class V, class Real>
SB_INLINE V load(const Real* p) {
  V v;
  if constexpr (std::is_same_v<V, DoubleLane>) {
    std::memcpy(&v.lo, p, sizeof v.lo);
    std::memcpy(&v.hi, p + lanes / 2, sizeof v.hi);
  } else {
    std::memcpy(&v, p, sizeof v);
  }
  return v;
}

template <class V, class Real>
SB_INLINE void store(Real* p, const V& v) {
  if constexpr (std::is_same_v<V, DoubleLane>) {
    std::memcpy(p, &v.lo, sizeof v.lo);
    std::memcpy(p + lanes / 2, &v.hi, sizeof v.hi);
  } else {
    std::memcpy(p, &v, sizeof v);
  }
}

template <class V, class Real>
SB_INLINE Vec<V> load(Field<Real> f, std::size_t at) {
  return {load<V>(f.x + at), load<V>(f.y + at), load<V>(f.z + at)};
}

template <class V, class Real>
SB_INLINE void store(Field<Real> f, std::size_t at, const Vec<V>& v) {
  store(f.x + at, v.x);
  store(f.y + at, v.y);
  store(f.z + at, v.z);
}

/// As many lanes of doubles as registers hold a dozen sums of, and the same of floats.
template <int width>
using DoublePart = std::conditional_t<width == one_lane, double, DoubleLane::Half>;
typedef float HalfLane __attribute__((vector_size(lanes / 2 * sizeof(float))));
template <int width>
using FloatPart = std::conditional_t<width == one_lane, float, HalfLane>;

SB_INLINE double widened(float v) { return double(v); }
SB_INLINE DoubleLane::Half widened(HalfLane v) { return __builtin_convertvector(v, DoubleLane::Half); }
SB_INLINE float narrowed(double v) { return float(v); }
SB_INLINE HalfLane narrowed(DoubleLane::Half v) { return __builtin_convertvector(v, HalfLane); }

template <class V>
SB_INLINE auto widened(const Vec<V>& v) {
  return Vec<decltype(widened(v.x))>{widened(v.x), widened(v.y), widened(v.z)};
}

template <class V>
SB_INLINE Vec<V> load(const LaneVector& v) {
  return {load<V>(v.x), load<V>(v.y), load<V>(v.z)};
}

SB_INLINE Field<double> field(DoubleLaneVector& v) { return {v.x, v.y, v.z}; }
SB_INLINE Field<const double> field(const DoubleLaneVector& v) { return {v.x, v.y, v.z}; }

/// The lanes in which a > b, as bits.
template <class V>
SB_INLINE unsigned lanes_above(V a, V b) {
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l) bits |= unsigned(a[l] > b[l]) << l;
  return bits;
}

SB_INLINE unsigned lanes_above(float a, float b) { return a > b; }

/// Hooke's spring with a damper along it: f = (k (L - L0) + c (dv . dx) / L) dx / L on i, minus that on j, so
/// (k (L - L0) L + c dv . dx) dx / L^2: root and quotient need not wait for each other.
/// A spring of length zero has no direction and pulls nowhere.
template <class Real, int width>
SB_INLINE void springs(std::span<const KernelSpring<Real>> list, Field<const Real> x, Field<const Real> v,
                       Field<Real> f) {
  using V = Lane<Real, width>;
  const V tiny = V{} + Real(1e-24);  // m^2: its inverse is finite, and times a pull of 0 it is 0
  for (const KernelSpring<Real>& s : list) {
    const Vec<V> dx = load<V>(x, s.j) - load<V>(x, s.i), dv = load<V>(v, s.j) - load<V>(v, s.i);
    const V square = dot(dx, dx), length = square_root(square);
    const V pull = s.stiffness * (length - s.rest) * length + s.damping * dot(dv, dx);
    const Vec<V> force = (pull * (Real(1) / larger(square, tiny))) * dx;
    store(f, s.i, load<V>(f, s.i) + force);
    store(f, s.j, load<V>(f, s.j) - force);
  }
}

/// XPBD, one pass without accumulated multipliers (Macklin et al. 2016, eq. 18 and 26 times the stiffness): the spring
/// as a constraint of compliance 1 / k with its damper. Particles are at x + d, d their displacements in this step:
/// these are small, so that floats leave velocities their digits.
template <int width>
SB_INLINE void project_springs(const ProjectArguments& p, std::span<const KernelSpring<float>> list,
                               Field<const float> x, Field<float> d) {
  using V = Lane<float, width>;
  const V tiny = V{} + 1e-12f;  // m
  const V inverse_mass = p.inverse_mass * load<V>(p.moves);
  const float inverse_h = 1 / p.h, inverse_h2 = inverse_h * inverse_h;
  for (const KernelSpring<float>& s : list) {
    const Vec<V> di = load<V>(d, s.i), dj = load<V>(d, s.j), moved = dj - di;
    const Vec<V> dx = (load<V>(x, s.j) - load<V>(x, s.i)) + moved;
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
template <class Real, int width>
SB_INLINE void volume(std::span<const KernelTriangle> faces, Field<const Real> x, Real* result) {
  using V = Lane<Real, width>;
  constexpr std::size_t block = 16;
  const Vec<V> from = faces.empty() ? Vec<V>{} : load<V>(x, faces[0][0]);
  V six{};
  for (std::size_t first = 0; first < faces.size(); first += block) {
    V part{};
    for (const auto& [a, b, c] : faces.subspan(first, std::min(block, faces.size() - first)))
      part += dot(load<V>(x, a) - from, cross(load<V>(x, b) - from, load<V>(x, c) - from));
    six += part;
  }
  store(result, six / Real(6));
}

/// See Surface: of two medians of one face, the largest sum.
template <int width>
SB_INLINE void medians(std::span<const KernelTriangle> faces, Field<const float> x, float* result) {
  using V = Lane<float, width>;
  V largest{};
  for (const auto& [a, b, c] : faces) {
    const Vec<V> ab = load<V>(x, b) - load<V>(x, a), ac = load<V>(x, c) - load<V>(x, a);
    const Vec<V> bc = ac - ab, twice_a = ab + ac, twice_b = bc - ab,
                 twice_c = bc + ac;  // each of length twice a median
    const V from_a = square_root(dot(twice_a, twice_a)), from_b = square_root(dot(twice_b, twice_b)),
            from_c = square_root(dot(twice_c, twice_c));
    largest = larger(larger(from_a + from_b, larger(from_b + from_c, from_c + from_a)), largest);
  }
  store(result, largest / 2.0f);
}

/// See Surface: adds the springs' stiffness times the squared difference of the vectors at their ends.
template <int width>
SB_INLINE void stretch(std::span<const KernelSpring<float>> list, Field<const float> a, float* sum) {
  using V = Lane<float, width>;
  V all = load<V>(sum);
  for (const KernelSpring<float>& s : list) {
    const Vec<V> d = load<V>(a, s.j) - load<V>(a, s.i);
    all += s.stiffness * dot(d, d);
  }
  store(sum, all);
}

/// The sum of the squared lengths of so many vectors.
template <int width>
SB_INLINE void square_sum(std::size_t particles, Field<const float> a, float* sum) {
  using V = Lane<float, width>;
  V all{};
  for (std::size_t i = 0; i < particles; ++i) {
    const Vec<V> v = load<V>(a, i * width);
    all += dot(v, v);
  }
  store(sum, all);
}

/// A third of each face's pressure force to each of its corners (Matyka & Ollila 2003).
template <class Real, int width>
SB_INLINE void pressure(std::span<const KernelTriangle> faces, Field<const Real> x, const Real* gauge, Field<Real> f) {
  using V = Lane<Real, width>;
  const V sixth = load<V>(gauge) / Real(6);
  for (const auto& [a, b, c] : faces) {
    const Vec<V> pa = load<V>(x, a);
    const Vec<V> third = sixth * cross(load<V>(x, b) - pa, load<V>(x, c) - pa);
    store(f, a, load<V>(f, a) + third);
    store(f, b, load<V>(f, b) + third);
    store(f, c, load<V>(f, c) + third);
  }
}

/// What the fit of the shape needs. Seen from one of the particles and added up in blocks, as volume() is.
template <class Real, int width>
SB_INLINE void shape_moments(std::span<const ShapePoint<Real>> shape, Field<const Real> x, ShapeMoments<Real>& m) {
  using V = Lane<Real, width>;
  constexpr std::size_t block = 16;
  const Vec<V> from = load<V>(x, 0);
  Vec<V> sum{}, covariance[3]{};
  for (std::size_t first = 0; first < shape.size(); first += block) {
    Vec<V> part{}, a{}, b{}, c{};
    for (std::size_t i = first; i < std::min(first + block, shape.size()); ++i) {
      const Vec<V> d = load<V>(x, i * width) - from;
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
template <class Real, int width>
SB_INLINE void shape_pull(std::span<const ShapePoint<Real>> shape, const ShapePose<Real>& pose, Real stiffness,
                          Field<const Real> x, Field<Real> f) {
  using V = Lane<Real, width>;
  const Vec<V> centre{load<V>(pose.centre[0]), load<V>(pose.centre[1]), load<V>(pose.centre[2])};
  Vec<V> column[3];
  for (int k = 0; k < 3; ++k)
    column[k] = {load<V>(pose.rotation[3 * k]), load<V>(pose.rotation[3 * k + 1]), load<V>(pose.rotation[3 * k + 2])};
  const V pull = V{} + stiffness;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Vec<V> goal =
        centre + (V{} + shape[i].x) * column[0] + (V{} + shape[i].y) * column[1] + (V{} + shape[i].z) * column[2];
    store(f, i * width, load<V>(f, i * width) + pull * (goal - load<V>(x, i * width)));
  }
}

template <int width>
SB_INLINE void kick(const KickArguments& k, Field<const float> f, Field<float> v) {
  using V = Lane<float, width>;
  const V moves = load<V>(k.moves);
  const V scale = k.h_over_mass * moves;
  const Vec<V> g{k.gx * moves, k.gy * moves, k.gz * moves};
  for (std::size_t at = 0; at < k.particles * width; at += width)
    store(v, at, load<V>(v, at) + scale * load<V>(f, at) + g);
}

template <int width>
SB_INLINE void drift(std::size_t particles, float h, const float* moves, Field<const float> v, Field<float> x) {
  using V = Lane<float, width>;
  const V step = h * load<V>(moves);
  for (std::size_t at = 0; at < particles * width; at += width) store(x, at, load<V>(x, at) + step * load<V>(v, at));
}

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

template <int width>
SB_INLINE void extent(std::size_t particles, Field<const float> boxed, Field<const float> measured, Extent& e) {
  using V = Lane<float, width>;
  Vec<V> lo = load<V>(boxed, 0), hi = lo;
  V length2{};
  for (std::size_t at = 0; at < particles * width; at += width) {
    const Vec<V> p = load<V>(boxed, at), u = load<V>(measured, at);
    lo = {smaller(p.x, lo.x), smaller(p.y, lo.y), smaller(p.z, lo.z)};
    hi = {larger(p.x, hi.x), larger(p.y, hi.y), larger(p.z, hi.z)};
    length2 = larger(dot(u, u), length2);
  }
  store(Field<float>{e.lo.x, e.lo.y, e.lo.z}, 0, lo);
  store(Field<float>{e.hi.x, e.hi.y, e.hi.z}, 0, hi);
  store(e.length2, length2);
}

template <int width>
SB_INLINE void rigid_sums(std::size_t particles, Field<const float> x, Field<const float> v, RigidSums& sums) {
  using V = DoublePart<width>;
  using F = FloatPart<width>;
  for (std::size_t lane = 0; lane < width; lane += sizeof(V) / sizeof(double)) {
    const Vec<V> first = widened(load<F>(x, lane));
    Vec<V> place{}, velocity{}, momentum{}, square{}, mixed{};
    for (std::size_t at = lane; at < particles * width; at += width) {
      const Vec<V> r = widened(load<F>(x, at)) - first, u = widened(load<F>(v, at));
      place = place + r;
      velocity = velocity + u;
      momentum = momentum + cross(r, u);
      square = square + Vec<V>{r.x * r.x, r.y * r.y, r.z * r.z};
      mixed = mixed + Vec<V>{r.y * r.z, r.z * r.x, r.x * r.y};
    }
    store(field(sums.place), lane, place);
    store(field(sums.velocity), lane, velocity);
    store(field(sums.momentum), lane, momentum);
    store(field(sums.square), lane, square);
    store(field(sums.mixed), lane, mixed);
  }
}

template <int width>
SB_INLINE void add_rigid(std::size_t particles, const RigidChange& change, Field<const float> x, Field<float> v) {
  using V = DoublePart<width>;
  using F = FloatPart<width>;
  for (std::size_t lane = 0; lane < width; lane += sizeof(V) / sizeof(double)) {
    const F acts = load<F>(change.acts + lane), zero{};
    const auto either = [&](F before, V after) { return acts > zero ? narrowed(after) : before; };
    const Vec<V> push = load<V>(field(change.push), lane), spin = load<V>(field(change.spin), lane);
    const Vec<V> centre = widened(load<F>(x, lane)) + load<V>(field(change.about), lane);
    for (std::size_t at = lane; at < particles * width; at += width) {
      const Vec<F> before = load<F>(v, at);
      const Vec<V> after = widened(before) + push + cross(spin, widened(load<F>(x, at)) - centre);
      store(v, at, Vec<F>{either(before.x, after.x), either(before.y, after.y), either(before.z, after.z)});
    }
  }
}

}  // namespace softbody::body
