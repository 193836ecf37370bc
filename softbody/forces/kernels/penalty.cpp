#include "softbody/forces/kernels/penalty.h"

#include <hwy/cache_control.h>

#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "softbody/forces/kernels/penalty.cpp"
#include <hwy/foreach_target.h>

#include "softbody/forces/penalty_law.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace {

using namespace simd;
using V = Lane<float, register_lanes<float>>;
constexpr std::size_t step = lanes_of<V>;

/// Calls use(first) for the registers of pairs of a part.
template <class Use>
HWY_INLINE void for_each_register(collide::Part part, const Use& use) {
  const auto block = [](std::size_t pair) { return (pair + lanes - 1) / lanes * lanes; };
  for (std::size_t at = block(part.begin); at < block(part.end); at += step) use(at);
}

template <class W>
HWY_INLINE Vec<W> vector(const Quad<W>& q) {
  return {q.x, q.y, q.z};
}
HWY_INLINE Quad<V> first(const PenaltyParticle* table, const std::uint32_t* particles) {
  return gather_quads<V>(&table->first.x, sizeof *table / sizeof(float), particles);
}
HWY_INLINE Quad<V> second(const PenaltyParticle* table, const std::uint32_t* particles) {
  return gather_quads<V>(&table->second.x, sizeof *table / sizeof(float), particles);
}

/// Returns the way from b to a, in m.
HWY_INLINE Vec<V> between(const PenaltyPairs& p, const PenaltyParticle* motion, std::size_t at) {
  return vector(first(motion, p.a.data() + at)) - vector(first(motion, p.b.data() + at)) + load<V>(field(p.offset), at);
}

/// Returns the unit vector along v, or up if v has no length.
template <class W>
HWY_INLINE Vec<W> direction(const Vec<W>& v) {
  const W length = square_root(dot(v, v));
  const auto some = length > W(0);
  return select(some, (W(1) / select(some, length, W(1))) * v, Vec<W>{W(0), W(1), W(0)});
}

void evaluate(collide::Part part, PenaltyPairs& p, const PenaltyParticle* motion, const PenaltyStep& s,
              glm::vec4* force) {
  constexpr std::size_t ahead = 64;  // pairs, of which the second particle stands anywhere
  const std::size_t last = p.b.size() - step;
  for_each_register(part, [&](std::size_t at) HWY_ATTR {
    for (std::size_t i = std::min(at + ahead, last), end = i + step; i < end; ++i) hwy::Prefetch(motion + p.b[i]);
    const Vec<V> velocity = vector(second(motion, p.a.data() + at)) - vector(second(motion, p.b.data() + at));
    const PenaltyLaw<V> law{load<V>(p.stiffness.data() + at), V(s.thickness), load<V>(p.friction.data() + at),
                            V(s.damper_limit) * load<V>(p.damped_mass.data() + at)};
    Vec<V> stretch = load<V>(field(p.stretch), at);
    const Vec<V> d = between(p, motion, at), normal = load<V>(field(p.normal), at);
    const Vec<V> f = law.force(d, velocity, normal, V(s.seconds), stretch);
    store(field(p.stretch), at, stretch);
    store_quads(&force[at].x, Quad<V>{f.x, f.y, f.z, V(0)});
    if (!s.impulse) return;
    // What the dampers take, which share the mass: their impulse changes the speed while it acts.
    const V e = load<V>(p.restitution.data() + at), at_rest = law.push_at_rest(dot(d, normal), dot(d, d));
    const V u = dot(velocity, normal), pushed = law.push(at_rest, u), damped = V(s.seconds) * (at_rest - pushed);
    const V taken = damped * (u - damped / load<V>(p.damped_mass.data() + at));
    store(s.impulse + at, load<V>(s.impulse + at) + V(s.seconds) * pushed);
    store(s.returned + at, load<V>(s.returned + at) + e * e * taken);
  });
}

void measure(collide::Part part, const PenaltyPairs& p, const PenaltyParticle* motion, float thickness,
             double* stored) {
  float energy[lanes];
  for_each_register(part, [&](std::size_t at) HWY_ATTR {
    const PenaltyLaw<V> law{load<V>(p.stiffness.data() + at), V(thickness)};
    const Vec<V> d = between(p, motion, at), stretch = load<V>(field(p.stretch), at);
    const V s = dot(d, load<V>(field(p.normal), at));
    store(energy + at % lanes, law.stored(s, dot(d, d) - s * s) + law.stored_by_friction(dot(stretch, stretch)));
    if ((at + step) % lanes != 0) return;
    const std::size_t block = at / lanes;
    const float* end = energy + std::min<std::size_t>(lanes, p.size() - lanes * block);
    stored[block] = std::accumulate<const float*>(energy, end, 0.0);
  });
}

void prepare(collide::Part part, PenaltyPairs& p, const PenaltyParticle* motion, const PenaltyParticle* traits) {
  for_each_register(part, [&](std::size_t at) HWY_ATTR {
    const Quad<V> normal_a = first(traits, p.a.data() + at), normal_b = first(traits, p.b.data() + at);
    const Quad<V> a = second(traits, p.a.data() + at), b = second(traits, p.b.data() + at);
    const Vec<V> apart = vector(normal_b) - vector(normal_a), way = direction(between(p, motion, at));
    // Surfaces that face the same way tell nothing.
    const auto facing = select(larger(b.w - a.w, a.w - b.w) > V(0), dot(apart, apart), V(0)) > V(0.25f);
    const V friction = square_root(a.y * b.y);
    store(field(p.normal), at, select(facing, direction(apart), way));
    store(p.stiffness.data() + at, smaller(a.x, b.x) / larger(normal_a.w, normal_b.w));
    store(p.friction.data() + at, friction);
    store(p.damped_mass.data() + at, smaller(a.z, b.z) / square_root(V(1) + friction * friction));
  });
}

template <int width>
void normals_of(const Batch& batch, Field<const float> x, std::span<const std::uint32_t> slots,
                PenaltyParticle* traits) {
  using W = Run<float, width>;
  LaneVector normal;
  Index done = ~Index{0};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::size_t at = slots[i] - batch.base;
    const auto vertex = Index(at / width);
    for (std::size_t l = 0; vertex != done && l < std::size_t(batch.used); l += lanes_of<W>) {
      Vec<W> sum{};  // of the faces' normals times twice their areas
      for (const Index face : batch.model->faces_of(vertex)) {
        const auto& [a, b, c] = batch.model->mesh.triangles[face];
        const Vec<W> corner = load<W>(x + l, a * width);
        sum = sum + cross(load<W>(x + l, b * width) - corner, load<W>(x + l, c * width) - corner);
      }
      store(field(normal), l, direction(sum));
    }
    done = vertex;
    traits[i].first = glm::vec4(normal[at % width], traits[i].first.w);
  }
}

void set_normals(const Batch& batch, Field<const float> x, std::span<const std::uint32_t> slots,
                 PenaltyParticle* traits) {
  with_width(batch.width, [&](auto width) { normals_of<width>(batch, x, slots, traits); });
}

void add(std::span<const std::uint32_t> slots, const std::uint32_t* first_end, const PenaltyEnd* ends,
         const glm::vec4* force, std::size_t base, Field<float> f) {
  using One = Wide<float, 4>;
  constexpr std::uint32_t ahead = 32;  // ends, of pairs that stand anywhere
  const std::uint32_t last = first_end[slots.size()];
  for (std::size_t i = 0; i < slots.size(); ++i) {
    One sum(0.0f);
    for (std::uint32_t e = first_end[i]; e < first_end[i + 1]; ++e) {
      hwy::Prefetch(force + ends[std::min(e + ahead, last - 1)].pair);
      sum += One(ends[e].sign()) * load<One>(&force[ends[e].pair].x);
    }
    float more[4];
    store(more, sum);
    softbody::add(f, slots[i] - base, {more[0], more[1], more[2]});
  }
}

const PenaltyKernels& Table() {
  static constexpr PenaltyKernels table{evaluate, measure, prepare, set_normals, add};
  return table;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(Table);

const PenaltyKernels& penalty_kernels() { return HWY_DYNAMIC_DISPATCH(Table)(); }

}  // namespace softbody
#endif  // HWY_ONCE
