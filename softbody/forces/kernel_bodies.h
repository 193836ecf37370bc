// Arithmetic of forces: V is one value for each of several lanes, whose first one the fields begin with, or a float or
// double of a body that is alone. Compiled for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_FORCES_KERNEL_BODIES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_FORCES_KERNEL_BODIES_H
#undef SOFTBODY_FORCES_KERNEL_BODIES_H
#else
#define SOFTBODY_FORCES_KERNEL_BODIES_H
#endif

#include <algorithm>
#include <span>

#include "softbody/forces/kernel_types.h"
#include "softbody/state/lane_math.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace body {

/// Hooke's spring with a damper along it: f = (k (L - L0) + c (dv . dx) / L) dx / L on i, minus that on j, so
/// (k (L - L0) L + c dv . dx) dx / L^2, in which the root and the quotient do not wait for each other.
/// A spring of length zero has no direction and exerts no force.
template <class V>
HWY_INLINE void springs(std::span<const KernelSpring<Value<V>>> list, Field<const Value<V>> x, Field<const Value<V>> v,
                        Field<Value<V>> f) {
  using Real = Value<V>;
  const V tiny = V(Real(1e-24));  // m^2: its inverse is finite, and times a pull of 0 it is 0
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
/// as a constraint of compliance 1 / k with its damper. Particles are at x + d. Their displacements d in this step are
/// small, so that velocities lose no digits in floats.
template <class V>
HWY_INLINE void project_springs(const ProjectArguments& p, std::span<const KernelSpring<float>> list,
                                Field<const float> x, Field<float> d) {
  const V tiny = V(1e-12f);  // m
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

/// Signed volume by the divergence theorem: the sum of a . (b x c) / 6 over the faces. Corners are taken relative to
/// one of them and summed in blocks, because rounding errors of the volume would make a body at rest pulsate.
template <class V>
HWY_INLINE void volume(std::span<const KernelTriangle> faces, Field<const Value<V>> x, Value<V>* result) {
  using Real = Value<V>;
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

/// SurfaceShape::two_medians: the largest sum of two medians of one face.
template <class V>
HWY_INLINE void medians(std::span<const KernelTriangle> faces, Field<const float> x, float* result) {
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

/// SurfaceShape::stretch: adds the springs' stiffness times the squared difference of the vectors at their ends.
template <class V>
HWY_INLINE void stretch(std::span<const KernelSpring<float>> list, Field<const float> a, float* sum) {
  V all = load<V>(sum);
  for (const KernelSpring<float>& s : list) {
    const Vec<V> d = load<V>(a, s.j) - load<V>(a, s.i);
    all += s.stiffness * dot(d, d);
  }
  store(sum, all);
}

/// Adds a third of each face's pressure force to each of its corners (Matyka & Ollila 2003).
template <class V>
HWY_INLINE void pressure(std::span<const KernelTriangle> faces, Field<const Value<V>> x, const Value<V>* gauge,
                         Field<Value<V>> f) {
  using Real = Value<V>;
  const V sixth = load<V>(gauge) / Real(6);
  for (const auto& [a, b, c] : faces) {
    const Vec<V> pa = load<V>(x, a);
    const Vec<V> third = sixth * cross(load<V>(x, b) - pa, load<V>(x, c) - pa);
    store(f, a, load<V>(f, a) + third);
    store(f, b, load<V>(f, b) + third);
    store(f, c, load<V>(f, c) + third);
  }
}

/// Computes the moments for fit_shape(), relative to one of the particles and in blocks, as in volume().
template <class V, int width>
HWY_INLINE void shape_moments(std::span<const ShapePoint<Value<V>>> shape, Field<const Value<V>> x,
                              ShapeMoments<Value<V>>& m, std::size_t lane = 0) {
  using Real = Value<V>;
  constexpr std::size_t block = 16;
  const Vec<V> from = load<V>(x, 0);
  Vec<V> sum{}, covariance[3]{};
  for (std::size_t first = 0; first < shape.size(); first += block) {
    Vec<V> part{}, a{}, b{}, c{};
    for (std::size_t i = first; i < std::min(first + block, shape.size()); ++i) {
      const Vec<V> d = load<V>(x, i * width) - from;
      part = part + d;
      a = a + V(shape[i].x) * d;
      b = b + V(shape[i].y) * d;
      c = c + V(shape[i].z) * d;
    }
    sum = sum + part;
    covariance[0] = covariance[0] + a;
    covariance[1] = covariance[1] + b;
    covariance[2] = covariance[2] + c;
  }
  const V share = V(Real(1) / static_cast<Real>(shape.size()));
  store(Field<Real>{m.mean[0], m.mean[1], m.mean[2]}, lane, from + share * sum);
  for (int k = 0; k < 3; ++k)
    store(Field<Real>{m.covariance[3 * k], m.covariance[3 * k + 1], m.covariance[3 * k + 2]}, lane, covariance[k]);
}

/// Pulls each particle to its goal: f += stiffness (centre + R q - x).
template <class V, int width>
HWY_INLINE void shape_pull(std::span<const ShapePoint<Value<V>>> shape, const ShapePose<Value<V>>& pose,
                           Value<V> stiffness, Field<const Value<V>> x, Field<Value<V>> f, std::size_t lane = 0) {
  using Real = Value<V>;
  const auto vector = [lane](const Real(*v)[lanes]) HWY_ATTR -> Vec<V> {
    return {load<V>(v[0] + lane), load<V>(v[1] + lane), load<V>(v[2] + lane)};
  };
  const Vec<V> centre = vector(pose.centre);
  Vec<V> column[3];
  for (int k = 0; k < 3; ++k) column[k] = vector(pose.rotation + 3 * k);
  const V pull = V(stiffness);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Vec<V> goal = centre + V(shape[i].x) * column[0] + V(shape[i].y) * column[1] + V(shape[i].z) * column[2];
    store(f, i * width, load<V>(f, i * width) + pull * (goal - load<V>(x, i * width)));
  }
}

}  // namespace body
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
