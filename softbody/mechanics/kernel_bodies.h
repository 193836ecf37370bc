// How each coordinate (coordinates.h) acts on particles: V is one value for each of several lanes, whose first one the
// fields begin with, or a float or double of a body that is alone; width: the distance of a particle's values from the
// next one's. Compiled for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_FORCES_KERNEL_BODIES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_FORCES_KERNEL_BODIES_H
#undef SOFTBODY_FORCES_KERNEL_BODIES_H
#else
#define SOFTBODY_FORCES_KERNEL_BODIES_H
#endif

#include <algorithm>
#include <span>

#include "softbody/forces/spring_law.h"
#include "softbody/mechanics/kernel_types.h"
#include "softbody/state/simd.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace simd {

/// m^2: its inverse is finite, and times a pull of 0 it is 0.
template <class Real>
inline constexpr Real tiny_square = Real(1e-24);

/// Signed volume by the divergence theorem: the sum of a . (b x c) / 6 over the faces. Corners are taken relative to
/// one of them and summed in blocks, because rounding errors of the volume would make a body at rest pulsate.
template <class V, int width>
HWY_INLINE void volume(std::span<const Triangle> faces, Field<const Value<V>> x, Value<V>* result) {
  constexpr std::size_t block = 16;
  const Vec<V> from = faces.empty() ? Vec<V>{} : load<V>(x, faces[0][0] * width);
  V six{};
  for (std::size_t first = 0; first < faces.size(); first += block) {
    V part{};
    for (const auto& [a, b, c] : faces.subspan(first, std::min(block, faces.size() - first)))
      part += dot(load<V>(x, a * width) - from, cross(load<V>(x, b * width) - from, load<V>(x, c * width) - from));
    six += part;
  }
  store(result, six / Value<V>(6));
}

/// Adds a third of each face's pressure force to each of its corners (Matyka & Ollila 2003). gauge: Pa, for each lane.
template <class V, int width>
HWY_INLINE void push_faces(std::span<const Triangle> faces, Field<const Value<V>> x, const Value<V>* gauge,
                           Field<Value<V>> f) {
  const V sixth = load<V>(gauge) / Value<V>(6);
  for (const auto& [i, j, k] : faces) {
    const std::size_t a = i * width, b = j * width, c = k * width;
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
                              ShapeMoments<Value<V>>& m) {
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
  const V share = V(Real(1) / Real(shape.size()));
  store(Field<Real>{m.mean[0], m.mean[1], m.mean[2]}, 0, from + share * sum);
  for (int k = 0; k < 3; ++k)
    store(Field<Real>{m.covariance[3 * k], m.covariance[3 * k + 1], m.covariance[3 * k + 2]}, 0, covariance[k]);
}

/// Finds what a force finds once from all particles.
template <class F, class V, int width>
HWY_INLINE void hold(const typename F::Data& data, Field<const Value<V>> x, int used, HeldOf<F, Value<V>>& held) {
  if constexpr (F::coordinate == Coordinate::offset) {
    ShapeMoments<Value<V>> moments;
    shape_moments<V, width>(data.template elements<Value<V>>(), x, moments);
    fit_shape<Value<V>>(moments, std::min(used, lanes_of<V>), held);
  }
}

/// Calls at(element, law) for each element of a force in bodies of a model; of offsets at(element, place, law).
template <class F, class V, class At>
HWY_INLINE void visit(const BodyModel& model, const typename F::Data& data, const HeldOf<F, Value<V>>& held,
                      const At& at) {
  using Real = Value<V>;
  if constexpr (F::coordinate == Coordinate::length) {
    for (const auto& law : data.template elements<Real>()) at(Length{law.i, law.j}, law);
  } else if constexpr (F::coordinate == Coordinate::volume) {
    at(Volume{}, data);
  } else if constexpr (F::coordinate == Coordinate::path) {
    for (Index i = 0; i < model.mesh.vertices.size(); ++i) at(Path{i}, data);
  } else {
    const auto vector = [](const Real(*v)[lanes]) HWY_ATTR -> Vec<V> {
      return {load<V>(v[0]), load<V>(v[1]), load<V>(v[2])};
    };
    const Vec<V> centre = vector(held.centre);
    Vec<V> column[3];
    for (int k = 0; k < 3; ++k) column[k] = vector(held.rotation + 3 * k);
    for (Index i = 0; const auto& q : data.template elements<Real>())
      at(Offset{i++}, centre + V(q.x) * column[0] + V(q.y) * column[1] + V(q.z) * column[2], data);
  }
}

/// Returns the force on the first of two particles, dx and dv being those of the second from there: (pull(L) + c (dv .
/// dx) / L) dx / L, so (pull(L) L + c dv . dx) dx / L^2, in which the root and the quotient do not wait for each other.
/// Particles at the same place have no direction, and no force.
template <class V>
HWY_INLINE Vec<V> pull_between(const auto& law, const Vec<V>& dx, const Vec<V>& dv) {
  const V square = dot(dx, dx), length = square_root(square);
  const V pull = pull_at(law, length) * length + law.damping * dot(dv, dx);
  return (pull * (Value<V>(1) / larger(square, V(tiny_square<Value<V>>)))) * dx;
}

/// Adds the forces of elements.
template <class V, int width, class Motion>
struct AddForces {
  using Real = Value<V>;
  const LaneBodies<Real>& b;
  const Motion& motion;

  HWY_INLINE void operator()(Length c, const auto& law) const {
    const std::size_t i = c.i * width, j = c.j * width;
    const Vec<V> dx = load<V>(b.x, j) - load<V>(b.x, i);
    Vec<V> dv{};
    if constexpr (std::is_same_v<Motion, Moving>) dv = load<V>(motion.v, j) - load<V>(motion.v, i);
    Vec<V> force = pull_between<V>(law, dx, dv);
    if constexpr (std::is_same_v<Motion, SinceStart>)
      if (law.damping > 0) {
        const Vec<V> before = load<V>(motion.x, j) - load<V>(motion.x, i);
        const V gone = dot(dx - before, before) / larger(dot(before, before), V(tiny_square<Real>));
        force = force + (law.damping * motion.inverse_h * gone) * before;
      }
    store(b.f, i, load<V>(b.f, i) + force);
    store(b.f, j, load<V>(b.f, j) - force);
  }

  HWY_INLINE void operator()(Volume, const auto& law) const {
    Real volume[lanes]{}, gauge[lanes]{};
    simd::volume<V, width>(b.model.mesh.triangles, b.x, volume);
    for (int l = 0; l < std::min(b.used, lanes_of<V>); ++l) gauge[l] = Real(-law.pull(double(volume[l])));
    push_faces<V, width>(b.model.mesh.triangles, b.x, gauge, b.f);
  }

  HWY_INLINE void operator()(Offset c, const Vec<V>& place, const auto& law) const {
    const std::size_t i = c.i * width;
    store(b.f, i, load<V>(b.f, i) + V(Real(law.stiffness)) * (place - load<V>(b.x, i)));
  }

  HWY_INLINE void operator()(Path c, const auto& law) const {
    const std::size_t i = c.i * width;
    if constexpr (std::is_same_v<Motion, Moving>) {
      store(b.f, i, load<V>(b.f, i) - V(Real(law.damping)) * load<V>(motion.v, i));
    } else if constexpr (std::is_same_v<Motion, SinceStart>) {
      const Vec<V> rate = V(motion.inverse_h) * (load<V>(b.x, i) - load<V>(motion.x, i)) +
                          V(motion.inverse_carry_time) * load<V>(motion.carried, i);
      store(b.f, i, load<V>(b.f, i) - V(law.damping) * rate);
    }
  }
};

/// Calls at(law) for the elements of forces between two particles, a particle after the other: the lists ascend.
template <class Real>
class PairsOf {
 public:
  explicit PairsOf(const BodyModel& model) {
    for_each_force(Forces{}, [&]<class F>(Name<F>) {
      if constexpr (coordinate_of<F>() == Coordinate::length)
        if (const auto* d = data<F>(model)) std::get<index_of<F>>(next_) = d->template elements<Real>();
    });
  }
  /// Visits those whose first particle is i. To be called for each i, in ascending order.
  template <class At>
  HWY_INLINE void visit(Index i, const At& at) {
    for_each_force(Forces{}, [&]<class F>(Name<F>) HWY_ATTR {
      if constexpr (coordinate_of<F>() == Coordinate::length) {
        auto& next = std::get<index_of<F>>(next_);
        std::size_t count = 0;
        for (; count < next.size() && next[count].i == i; ++count) at(next[count]);
        next = next.subspan(count);
      }
    });
  }

 private:
  template <class... F>
  static std::tuple<std::span<const LengthLawOf<F, Real>>...> lists_of(List<F...>);
  decltype(lists_of(Forces{})) next_;
};

/// A volume v that becomes v + drift + yield P in a step, P being a pressure that pushes the faces outwards in it.
struct VolumeStep {
  double volume, drift, yield;  // m^3, m^3, m^3/Pa
};

/// Returns the pressure P that a law has at the end of the step: P = -pull(v + drift + yield P), by Newton's method.
/// There is one root, for the law's pressure falls as the volume grows. Each iterate lies on one side of it; the next
/// one stays between the two nearest, since where the law bends Newton's method alone would leap to and fro. The first
/// iterate is enough where the volume hardly changes. pull: returns a Jet.
inline double pressure_at_end(const VolumeStep& s, double start_volume, const auto& pull) {
  constexpr int most = 60;
  constexpr double little = 0.01, enough = 1e-5;  // of the starting volume
  const double whole = std::abs(start_volume);
  double at = 0, low = -HUGE_VAL, high = HUGE_VAL;  // changes of the volume
  for (int i = 0;; ++i) {
    const Jet law = pull(s.volume + at);
    (at < s.drift - s.yield * law.value ? low : high) = at;
    double next = (s.drift - s.yield * (law.value - law.slope * at)) / (1 + law.slope * s.yield);
    if (!(next > low && next < high))
      next = std::isfinite(low) && std::isfinite(high) ? (low + high) / 2 : std::clamp(next, low, high);
    if (i == most || std::abs(next - at) < (i == 0 ? little : enough) * whole)
      return -(law.value + law.slope * (next - at));
    at = next;
  }
}

/// Returns A = dV/dx of particle i, which is at x: a sixth of the sum of cross products over its faces.
template <class V, int width>
HWY_INLINE Vec<V> area_of(const LaneBodies<float>& b, Index i, const Vec<V>& x) {
  Vec<V> six{};
  for (const auto& [j, l] : b.model.edges_opposite(i))
    six = six + cross(load<V>(b.x, j * width) - x, load<V>(b.x, l * width) - x);
  return V(1.0f / 6) * six;
}

/// The change of velocity in a substep, v += h (f / m + g), but for the gas, in one pass over the particles. The forces
/// between two of them act where the pass comes to the first one, which is complete then: nothing after it needs its
/// velocity of old or its force. So the velocity gets its new value, and the place of the force takes A = dV/dx.
template <class V, int width>
HWY_INLINE void kick(const LaneBodies<float>& b, const KickArguments& k, Field<float> v, LaneVolumes& volumes,
                     std::size_t lane) {
  constexpr std::size_t block = 16;  // of particles, summed by themselves as in volume()
  const std::size_t particles = b.model.mesh.vertices.size();
  const bool presses = b.model.forces->pressure > 0;
  const V moves = load<V>(k.moves), scale = V(k.h_over_mass) * moves;
  const Vec<V> g{k.gx * moves, k.gy * moves, k.gz * moves}, from = load<V>(b.x, 0);
  PairsOf<float> pairs(b.model);
  V three_volumes{}, rate{}, square{};
  for (std::size_t first = 0; first < particles; first += block) {
    V part{};
    for (auto i = Index(first); i < std::min(first + block, particles); ++i) {
      const std::size_t at = i * width;
      const Vec<V> x = load<V>(b.x, at), before = load<V>(v, at);
      Vec<V> force = load<V>(b.f, at);
      pairs.visit(i, [&](const auto& law) HWY_ATTR {
        const std::size_t j = law.j * width;
        const Vec<V> pull = pull_between<V>(law, load<V>(b.x, j) - x, load<V>(v, j) - before);
        force = force + pull;
        store(b.f, j, load<V>(b.f, j) - pull);
      });
      const Vec<V> u = before + scale * force + g;
      store(v, at, u);
      if (!presses) continue;
      const Vec<V> area = area_of<V, width>(b, i, x);
      store(b.f, at, area);
      part += dot(area, x - from);
      rate += dot(area, u);
      square += dot(area, area);
    }
    three_volumes += part;
  }
  store(volumes.volume + lane, three_volumes / V(3.0f));
  store(volumes.rate + lane, rate);
  store(volumes.square + lane, square);
  store(volumes.pressure + lane, V{});
}

/// Changes the velocities by the gas, h P A / m: f: A. The pressure P depends on all particles, so that gas comes last:
/// explicitly, or such as P is at the end of the substep, where the volume has become V + h A . (v + h P A / m). That
/// is one number for each body, and stable at any h. The sum of A over a closed mesh is 0, so the momentum stays. What
/// the velocities have of P already, volumes.pressure, is replaced.
template <class V, int width>
HWY_INLINE void press(const LaneBodies<float>& b, const KickArguments& k, bool implicit_volume, Field<float> v,
                      LaneVolumes& volumes, std::size_t first) {
  const auto pull = [&](double volume) { return volume_pull(b.model, volume); };
  const double h = implicit_volume ? double(k.h) : 0, h_over_mass = double(k.h_over_mass);
  float push[lanes]{};
  for (int l = 0; l < std::min(b.used, lanes_of<V>); ++l) {
    const std::size_t lane = first + std::size_t(l);
    const double yield = h * h_over_mass * double(volumes.square[lane]), before = double(volumes.pressure[lane]);
    const VolumeStep step{double(volumes.volume[lane]), h * double(volumes.rate[lane]) - yield * before, yield};
    const double pressure = pressure_at_end(step, b.model.start_volume, pull);
    volumes.pressure[lane] = float(pressure);
    push[l] = float(h_over_mass * (pressure - before)) * k.moves[l];
  }
  const V pushes = load<V>(push);
  for (std::size_t at = 0; at < b.model.mesh.vertices.size() * width; at += width)
    store(v, at, load<V>(v, at) + pushes * load<V>(b.f, at));
}

/// Moves the positions by the velocities, and makes the forces 0.
template <class V, int width>
HWY_INLINE void drift(const LaneBodies<float>& b, const KickArguments& k, Field<const float> v, Field<float> x) {
  const V step = k.h * load<V>(k.moves);
  for (std::size_t at = 0; at < b.model.mesh.vertices.size() * width; at += width) {
    store(x, at, load<V>(x, at) + step * load<V>(v, at));
    store(b.f, at, Vec<V>{});
  }
}

/// XPBD, one pass without accumulated multipliers (Macklin et al. 2016, eq. 18 and 26 times the stiffness): a law as a
/// constraint of compliance 1 / k with its damper. Particles are at x0 + d. Their displacements d in this step are
/// small, so that velocities lose no digits in floats. No element moves a particle by more than the body's radius: what
/// is farther off is no longer near its first order, and a body that is torn out that far would fling itself apart.
/// holds: some particles are held, and do not move.
template <class V, int width, bool holds>
struct Project {
  const LaneBodies<float>& b;
  const Projection& p;
  float inverse_mass;  // 1/kg, of a particle

  /// Returns a vector for a particle: 0 if it is held.
  HWY_INLINE Vec<V> if_free(std::size_t at, const Vec<V>& vector) const {
    if constexpr (holds) return load<V>(p.free + at) * vector;
    return vector;
  }

  HWY_INLINE void operator()(Length c, const auto& law) const {
    const std::size_t i = c.i * width, j = c.j * width;
    const V tiny = V(1e-12f);  // m
    const float inverse_h = 1 / p.h, inverse_h2 = inverse_h * inverse_h;
    const Vec<V> di = load<V>(p.d, i), dj = load<V>(p.d, j), moved = dj - di;
    const Vec<V> dx = (load<V>(p.x0, j) - load<V>(p.x0, i)) + moved;
    const V length = square_root(dot(dx, dx));
    const Vec<V> n = (1.0f / larger(length, tiny)) * dx;
    const float damping = law.damping * inverse_h;
    const auto yields = [&] {
      if constexpr (holds) {
        const V both = load<V>(p.free + i) + load<V>(p.free + j);
        return V(1.0f) / ((law.stiffness + damping) * inverse_mass * both + V(inverse_h2));
      } else {
        return 1 / ((law.stiffness + damping) * 2 * inverse_mass + inverse_h2);
      }
    }();
    const V impulse = yields * (pull_at(law, length) + damping * dot(moved, n));
    const V most = V(float(b.model.radius)), way = (inverse_mass * load<V>(p.moves)) * impulse;
    const Vec<V> shift = smaller(larger(way, -most), most) * n;
    store(p.d, i, di + if_free(i, shift));
    store(p.d, j, dj - if_free(j, shift));
  }

  /// The limit of one constraint on the volume V, with the law as its compliance: along the gradient g of V that pull
  /// acts that the step ends with, to first order: pull(V) / (1 + pull'(V) h^2 |g|^2 / m). Wants b.x to be x0 + d.
  HWY_INLINE void operator()(Volume, const auto& law) const {
    constexpr std::size_t run = lanes_of<V>;
    const std::size_t size = b.model.mesh.vertices.size() * width;
    float volume[lanes]{}, unit[lanes], shift[lanes]{};
    double square[lanes]{}, largest[lanes]{};
    std::fill_n(unit, lanes, 1.0f);
    for (std::size_t at = 0; at < size; at += width) store(p.scratch, at, Vec<V>{});
    simd::volume<V, width>(b.model.mesh.triangles, b.x, volume);
    push_faces<V, width>(b.model.mesh.triangles, b.x, unit, p.scratch);
    if constexpr (holds)
      for (std::size_t at = 0; at < size; at += width) store(p.scratch, at, if_free(at, load<V>(p.scratch, at)));
    for (const float* gradient : {p.scratch.x, p.scratch.y, p.scratch.z})
      for (std::size_t at = 0; at < size; at += width)
        for (std::size_t l = 0; l < run; ++l) {
          const auto g = double(gradient[at + l]);
          square[l] += g * g;
          largest[l] = std::max(largest[l], std::abs(g));
        }
    const double h2_m = double(p.h) * double(p.h) / b.model.particle_mass;
    for (std::size_t l = 0; l < run; ++l) {
      const Jet pull = law.pull(Jet(double(volume[l]), 1));
      const double asked = h2_m * -pull.value / (1 + pull.slope * h2_m * square[l]), most = b.model.radius / largest[l];
      shift[l] = p.moves[l] * float(std::clamp(asked, -most, most));
    }
    const V shifted = load<V>(shift);
    for (std::size_t at = 0; at < size; at += width)
      store(p.d, at, load<V>(p.d, at) + shifted * load<V>(p.scratch, at));
  }

  /// The exact end of a step of this damper alone.
  HWY_INLINE void operator()(Path c, const auto& law) const {
    const std::size_t i = c.i * width;
    const float lost = 1 - 1 / (1 + p.h * float(law.damping) * inverse_mass);
    const Vec<V> d = load<V>(p.d, i);
    store(p.d, i, d - if_free(i, V(lost) * load<V>(p.moves) * d));
  }
};

/// SurfaceShape::two_medians of each lane: that of two medians is at most the root of twice the sum of their squares.
template <class V, int width>
HWY_INLINE void medians(std::span<const Triangle> faces, Field<const float> x, float* result) {
  V largest{};  // of four times these sums
  for (const auto& [a, b, c] : faces) {
    const Vec<V> pa = load<V>(x, a * width), ab = load<V>(x, b * width) - pa, ac = load<V>(x, c * width) - pa;
    const Vec<V> bc = ac - ab, twice_a = ab + ac, twice_b = bc - ab,
                 twice_c = bc + ac;  // each of length twice a median
    const V of_a = dot(twice_a, twice_a), of_b = dot(twice_b, twice_b), of_c = dot(twice_c, twice_c);
    largest = larger(of_a + of_b, larger(of_b + of_c, larger(of_c + of_a, largest)));
  }
  store(result, square_root(largest / 2.0f));
}

/// SurfaceShape::stretch: adds the stiffness of pairs times the squared difference of the vectors at their ends.
template <class V, int width>
struct AddStretch {
  Field<const float> area;
  V& sum;
  HWY_INLINE void operator()(Length c, const auto& law) const {
    const Vec<V> d = load<V>(area, c.j * width) - load<V>(area, c.i * width);
    sum += law.stiffness * dot(d, d);
  }
};

/// What the forces inside bodies store, in double.
template <class V>
struct StoredSums {
  double volume[lanes], rate[lanes];     // m^3 and m^3/s, of closed meshes
  double gas[lanes], gas_growth[lanes];  // J and W, of forces that depend on the volume
  V elastic, growth;                     // of the others
  V strain;                              // the largest of a spring
};

/// As volume(), and how fast it grows.
template <class V, int width>
HWY_INLINE void volume_and_rate(const MovingBodies& b, StoredSums<V>& sums) {
  const Vec<V> from = load<V>(b.x, b.model.mesh.triangles[0][0] * width);
  V six{}, rate{};
  for (const auto& [i, j, k] : b.model.mesh.triangles) {
    const Vec<V> a = load<V>(b.x, i * width), area = cross(load<V>(b.x, j * width) - a, load<V>(b.x, k * width) - a);
    six += dot(a - from, area);
    rate += dot(load<V>(b.v, i * width) + load<V>(b.v, j * width) + load<V>(b.v, k * width), area);
  }
  store(sums.volume, six / V(6.0));
  store(sums.rate, rate / V(6.0));
}

/// Adds what elements store, and how fast that grows. Wants the volumes.
template <class V, int width>
struct AddStored {
  const MovingBodies& b;
  StoredSums<V>& sums;

  HWY_INLINE void operator()(Length c, const auto& law) const {
    const std::size_t i = c.i * width, j = c.j * width;
    const V tiny = V(1e-12);  // m
    const Vec<V> dx = load<V>(b.x, j) - load<V>(b.x, i), dv = load<V>(b.v, j) - load<V>(b.v, i);
    const V length = square_root(dot(dx, dx));
    sums.elastic += stored_at(law, length);
    sums.growth += pull_at(law, length) * dot(dx, dv) / larger(length, tiny);
    if (law.rest > 0) {
      const V stretch = V(1 / law.rest) * length - V(1.0);
      sums.strain = larger(larger(stretch, -stretch), sums.strain);
    }
  }

  HWY_INLINE void operator()(Volume, const auto& law) const {
    for (int l = 0; l < std::min(b.used, lanes_of<V>); ++l) {
      sums.gas[l] += law.stored(sums.volume[l]);
      sums.gas_growth[l] += law.pull(sums.volume[l]) * sums.rate[l];
    }
  }

  HWY_INLINE void operator()(Offset c, const Vec<V>& place, const auto& law) const {
    const Vec<V> away = load<V>(b.x, c.i * width) - place;
    sums.elastic += V(law.stiffness / 2) * dot(away, away);
    sums.growth += V(law.stiffness) * dot(away, load<V>(b.v, c.i * width));
  }

  HWY_INLINE void operator()(Path, const auto&) const {}  // only damps
};

}  // namespace simd
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
