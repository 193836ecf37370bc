#pragma once
// How each coordinate (coordinates.h) acts on the particles of `width` bodies at a time: in lanes, or one alone. Each
// file that includes this compiles it for one instruction set.

#include <algorithm>

#include "softbody/forces/visit.h"
#include "softbody/state/kernel_bodies.h"

namespace softbody::body {

/// Signed volume by the divergence theorem: the sum of a . (b x c) / 6 over the faces. Corners are taken relative to
/// one of them and summed in blocks, because rounding errors of the volume would make a body at rest pulsate.
template <class Real, int width>
SB_INLINE void volume(std::span<const Triangle> faces, Field<const Real> x, Real* result) {
  using V = Lane<Real, width>;
  constexpr std::size_t block = 16;
  const Vec<V> from = faces.empty() ? Vec<V>{} : load<V>(x, faces[0][0] * width);
  V six{};
  for (std::size_t first = 0; first < faces.size(); first += block) {
    V part{};
    for (const auto& [a, b, c] : faces.subspan(first, std::min(block, faces.size() - first)))
      part += dot(load<V>(x, a * width) - from, cross(load<V>(x, b * width) - from, load<V>(x, c * width) - from));
    six += part;
  }
  store(result, six / Real(6));
}

/// Adds a third of each face's pressure force to each of its corners (Matyka & Ollila 2003). gauge: Pa, for each lane.
template <class Real, int width>
SB_INLINE void push_faces(std::span<const Triangle> faces, Field<const Real> x, const Real* gauge, Field<Real> f) {
  using V = Lane<Real, width>;
  const V sixth = load<V>(gauge) / Real(6);
  for (const auto& [i, j, k] : faces) {
    const std::size_t a = i * width, b = j * width, c = k * width;
    const Vec<V> pa = load<V>(x, a);
    const Vec<V> third = sixth * cross(load<V>(x, b) - pa, load<V>(x, c) - pa);
    store(f, a, load<V>(f, a) + third);
    store(f, b, load<V>(f, b) + third);
    store(f, c, load<V>(f, c) + third);
  }
}

/// Adds the forces of elements.
template <class R, int width, class Motion>
struct AddForces {
  using Real = R;
  using V = Lane<Real, width>;
  const LaneBodies<Real>& b;
  const Motion& motion;

  /// f = (pull(L) + c (dv . dx) / L) dx / L on i, minus that on j, so (pull(L) L + c dv . dx) dx / L^2, in which the
  /// root and the quotient do not wait for each other. Particles at the same place have no direction, and no force.
  SB_INLINE void operator()(Length c, const auto& law) const {
    const std::size_t i = c.i * width, j = c.j * width;
    const V tiny = V{} + Real(1e-24);  // m^2: its inverse is finite, and times a pull of 0 it is 0
    const Vec<V> dx = load<V>(b.x, j) - load<V>(b.x, i);
    const V square = dot(dx, dx), length = square_root(square);
    V pull = law.pull(length) * length;
    if constexpr (std::is_same_v<Motion, Moving>)
      pull = pull + law.damping * dot(load<V>(motion.v, j) - load<V>(motion.v, i), dx);
    Vec<V> force = (pull * (Real(1) / larger(square, tiny))) * dx;
    if constexpr (std::is_same_v<Motion, SinceStart>)
      if (law.damping > 0) {
        const Vec<V> before = load<V>(motion.x, j) - load<V>(motion.x, i);
        const V gone = dot(dx - before, before) / larger(dot(before, before), tiny);
        force = force + (law.damping * motion.inverse_h * gone) * before;
      }
    store(b.f, i, load<V>(b.f, i) + force);
    store(b.f, j, load<V>(b.f, j) - force);
  }

  SB_INLINE void operator()(Volume, const auto& law) const {
    alignas(64) Real volume[lanes]{}, gauge[lanes]{};
    body::volume<Real, width>(b.model.mesh.triangles, b.x, volume);
    for (int l = 0; l < b.used; ++l) gauge[l] = static_cast<Real>(-law.pull(double(volume[l])));
    push_faces<Real, width>(b.model.mesh.triangles, b.x, gauge, b.f);
  }

  SB_INLINE void operator()(const Offset<V>& c, const auto& law) const {
    const std::size_t i = c.i * width;
    store(b.f, i, load<V>(b.f, i) + (V{} + static_cast<Real>(law.stiffness)) * (c.place - load<V>(b.x, i)));
  }

  SB_INLINE void operator()(Path c, const auto& law) const {
    const std::size_t i = c.i * width;
    if constexpr (std::is_same_v<Motion, Moving>) {
      store(b.f, i, load<V>(b.f, i) - (V{} + static_cast<Real>(law.damping)) * load<V>(motion.v, i));
    } else if constexpr (std::is_same_v<Motion, SinceStart>) {
      const Vec<V> gone = load<V>(b.x, i) - load<V>(motion.x, i) + load<V>(motion.frame, i);
      store(b.f, i, load<V>(b.f, i) - (V{} + law.damping * motion.inverse_h) * gone);
    }
  }
};

/// XPBD, one pass without accumulated multipliers (Macklin et al. 2016, eq. 18 and 26 times the stiffness): a law as a
/// constraint of compliance 1 / k with its damper. Particles are at x0 + d. Their displacements d in this step are
/// small, so that velocities lose no digits in floats.
template <int width>
struct Project {
  using Real = float;
  using V = Lane<float, width>;
  const LaneBodies<float>& b;
  const Projection& p;
  float inverse_mass = float(1 / b.model.particle_mass);

  SB_INLINE void operator()(Length c, const auto& law) const {
    const std::size_t i = c.i * width, j = c.j * width;
    const V tiny = V{} + 1e-12f;  // m
    const float inverse_h = 1 / p.h, inverse_h2 = inverse_h * inverse_h;
    const Vec<V> di = load<V>(p.d, i), dj = load<V>(p.d, j), moved = dj - di;
    const Vec<V> dx = (load<V>(p.x0, j) - load<V>(p.x0, i)) + moved;
    const V length = square_root(dot(dx, dx));
    const Vec<V> n = (1.0f / larger(length, tiny)) * dx;
    const float damping = law.damping * inverse_h;
    const float yields = 1 / ((law.stiffness + damping) * 2 * inverse_mass + inverse_h2);
    const V impulse = yields * (law.pull(length) + damping * dot(moved, n));
    const Vec<V> shift = ((inverse_mass * load<V>(p.moves)) * impulse) * n;
    store(p.d, i, di + shift);
    store(p.d, j, dj - shift);
  }

  /// The limit of one constraint on the volume V, with the law as its compliance: along the gradient g of V that pull
  /// acts that the step ends with, to first order: pull(V) / (1 + pull'(V) h^2 |g|^2 / m). Wants b.x to be x0 + d.
  SB_INLINE void operator()(Volume, const auto& law) const {
    const std::size_t size = b.model.mesh.vertices.size() * width;
    alignas(64) float volume[lanes]{}, unit[lanes], shift[lanes];
    double square[lanes]{};
    std::fill_n(unit, lanes, 1.0f);
    for (float* component : {p.scratch.x, p.scratch.y, p.scratch.z}) std::fill_n(component, size, 0.0f);
    body::volume<float, width>(b.model.mesh.triangles, b.x, volume);
    push_faces<float, width>(b.model.mesh.triangles, b.x, unit, p.scratch);
    for (const float* gradient : {p.scratch.x, p.scratch.y, p.scratch.z})
      for (std::size_t at = 0; at < size; at += width)
        for (std::size_t l = 0; l < width; ++l) square[l] += double(gradient[at + l]) * double(gradient[at + l]);
    const double h2_m = double(p.h) * double(p.h) / b.model.particle_mass;
    for (std::size_t l = 0; l < width; ++l) {
      const Jet pull = law.pull(Jet(double(volume[l]), 1));
      shift[l] = p.moves[l] * float(h2_m * -pull.value / (1 + pull.slope * h2_m * square[l]));
    }
    const V shifted = load<V>(shift);
    for (std::size_t at = 0; at < size; at += width)
      store(p.d, at, load<V>(p.d, at) + shifted * load<V>(p.scratch, at));
  }

  /// The exact end of a step of this damper alone.
  SB_INLINE void operator()(Path c, const auto& law) const {
    const std::size_t i = c.i * width;
    const float kept = 1 / (1 + p.h * static_cast<float>(law.damping) * inverse_mass);
    const V moves = load<V>(p.moves);
    store(p.d, i, (kept * moves + (1.0f - moves)) * load<V>(p.d, i));
  }
};

/// SurfaceShape::two_medians of each lane: the largest sum of two medians of one face.
template <int width>
SB_INLINE void medians(std::span<const Triangle> faces, Field<const float> x, float* result) {
  using V = Lane<float, width>;
  V largest{};
  for (const auto& [a, b, c] : faces) {
    const Vec<V> pa = load<V>(x, a * width), ab = load<V>(x, b * width) - pa, ac = load<V>(x, c * width) - pa;
    const Vec<V> bc = ac - ab, twice_a = ab + ac, twice_b = bc - ab,
                 twice_c = bc + ac;  // each of length twice a median
    const V from_a = square_root(dot(twice_a, twice_a)), from_b = square_root(dot(twice_b, twice_b)),
            from_c = square_root(dot(twice_c, twice_c));
    largest = larger(larger(from_a + from_b, larger(from_b + from_c, from_c + from_a)), largest);
  }
  store(result, largest / 2.0f);
}

/// SurfaceShape::stretch: adds the stiffness of pairs times the squared difference of the vectors at their ends.
template <int width>
struct AddStretch {
  using Real = float;
  using V = Lane<float, width>;
  Field<const float> area;
  V& sum;
  SB_INLINE void operator()(Length c, const auto& law) const {
    const Vec<V> d = load<V>(area, c.j * width) - load<V>(area, c.i * width);
    sum += law.stiffness * dot(d, d);
  }
};

/// The surface of the body in each lane. b.f: room for dV/dx, and zero.
template <int width>
SB_INLINE void measure_surfaces(const LaneBodies<float>& b, SurfaceShape* result) {
  using V = Lane<float, width>;
  const std::vector<Triangle>& faces = b.model.mesh.triangles;
  alignas(64) float volume[lanes]{}, area2[lanes]{}, stretch[lanes]{}, two_medians[lanes]{}, one[lanes];
  std::fill_n(one, lanes, 1.0f);
  body::volume<float, width>(faces, b.x, volume);
  medians<width>(faces, b.x, two_medians);
  push_faces<float, width>(faces, b.x, one, b.f);
  square_sum<width>(b.model.mesh.vertices.size(), b.f, area2);
  V sum{};
  for_each_force(Forces{}, [&]<class F>(Name<F>) SB_LAMBDA {
    if constexpr (HasElements<F>) {
      if constexpr (F::coordinate == Coordinate::length)
        if (const auto* d = data<F>(b.model)) F::visit(*d, AddStretch<width>{b.f, sum});
    }
  });
  store(stretch, sum);
  for (int l = 0; l < b.used; ++l) result[l] = {volume[l], area2[l], stretch[l], two_medians[l]};
}

/// Adds one force.
template <class F, int width>
SB_INLINE void add_force(const LaneBodies<float>& b, const Moving& motion) {
  if (const auto* d = data<F>(b.model))
    visit_elements<F>(*d, hold<F, float, width>(*d, b.x, b.used), AddForces<float, width, Moving>{b, motion});
}

template <class F, int width>
SB_INLINE void project(const LaneBodies<float>& b, const Projection& p) {
  if (const auto* d = data<F>(b.model)) F::visit(*d, Project<width>{b, p});
}

SB_INLINE void hold_forces(const LaneBodies<double>& b, HeldForces& held) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) SB_LAMBDA {
    if constexpr (HasElements<F>)
      if (const auto* d = data<F>(b.model)) std::get<index_of<F>>(held) = hold<F, double, lanes>(*d, b.x, b.used);
  });
}

/// Adds all forces that have elements; external_only: those that are not internal.
template <bool external_only>
SB_INLINE void add_forces(const LaneBodies<double>& b, const HeldForces& held, const SinceStart& motion) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) SB_LAMBDA {
    if constexpr (HasElements<F>) {
      if constexpr (!external_only || !F::internal)
        if (const auto* d = data<F>(b.model))
          visit_elements<F>(*d, std::get<index_of<F>>(held), AddForces<double, lanes, SinceStart>{b, motion});
    }
  });
}

}  // namespace softbody::body
