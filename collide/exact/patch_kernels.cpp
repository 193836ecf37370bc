#include "collide/exact/patch_kernels.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/exact/patch_kernels.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide::exact {
namespace HWY_NAMESPACE {
namespace {

using namespace collide::HWY_NAMESPACE;

using Bytes = hn::ScalableTag<std::uint8_t>;
using SignedBytes = hn::ScalableTag<std::int8_t>;
constexpr std::size_t byte_lanes = hn::MaxLanes(Bytes());
constexpr Index size = Patches::size;
static_assert(size % lanes == 0 && 64 % byte_lanes == 0);

HWY_INLINE void fill_group(const VertexRun& body, const Index* vertex, Index group, Index offset, const ByteUnit& unit,
                           Patches& patches) {
  constexpr Index group_size = Patches::group_size;
  const Index to = offset + group;
  const Index here = std::min(size, (body.size - group * group_size + size - 1) / size);  // patches
  patches.count[to] = here;
  for (Index k = 0; k < here; ++k)
    patches.vertices[to * size + k] = std::min(size, body.size - (group * size + k) * size);
  float *const x = &patches.at[0][to * group_size], *const y = &patches.at[1][to * group_size];
  float* const z = &patches.at[2][to * group_size];
  for (Index k = 0; k < group_size; ++k) {
    const Index v = vertex[group * group_size + k];
    x[k] = body.x[v];
    y[k] = body.y[v];
    z[k] = body.z[v];
  }
  const hn::RebindToSigned<Floats> ints;
  const hn::RebindToUnsigned<Floats> words;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float* const at = &patches.at[axis][to * group_size];
    const V infinity = all(std::numeric_limits<float>::infinity());
    V group_lo = infinity, group_hi = hn::Neg(infinity);
    for (Index patch = 0; patch < size; patch += lanes) {
      V lo = infinity, hi = hn::Neg(infinity);
      hn::Vec<hn::RebindToUnsigned<Floats>> packed[4];
      for (std::size_t word = 0; word < 4; ++word) {
        const auto byte = [&](std::size_t k) HWY_ATTR {
          const V p = load(at + (4 * word + k) * size + patch);
          lo = hn::Min(lo, p);
          hi = hn::Max(hi, p);
          const auto q = hn::BitCast(words, hn::ConvertTo(ints, hn::Mul(p, all(unit.per_metre))));
          return hn::ShiftRight<24>(hn::Mul(q, hn::Set(words, unit.factor)));
        };
        packed[word] = hn::Or(hn::Or(byte(0), hn::ShiftLeft<8>(byte(1))),
                              hn::Or(hn::ShiftLeft<16>(byte(2)), hn::ShiftLeft<24>(byte(3))));
      }
      hn::StoreInterleaved4(packed[0], packed[1], packed[2], packed[3], words,
                            reinterpret_cast<std::uint32_t*>(&patches.bytes[axis][(to * size + patch) * size]));
      const M there = hn::FirstN(Floats(), here - std::min(here, patch));
      lo = hn::IfThenElse(there, lo, infinity);
      hi = hn::IfThenElse(there, hi, hn::Neg(infinity));
      hn::StoreU(lo, Floats(), &patches.patch.lo[axis][to * size + patch]);
      hn::StoreU(hi, Floats(), &patches.patch.hi[axis][to * size + patch]);
      group_lo = hn::Min(group_lo, lo);
      group_hi = hn::Max(group_hi, hi);
    }
    patches.group.lo[axis][to] = least(group_lo);
    patches.group.hi[axis][to] = most(group_hi);
    for (Index slot = body.size; slot < (group * size + here) * size; ++slot)  // of the body's last patch
      patches.at[axis][Patches::place(offset * size + slot / size, slot % size)] =
          std::numeric_limits<float>::quiet_NaN();
  }
}

void FillGroups(const VertexRun& body, const Index* vertex, Range groups, Index offset, const ByteUnit& unit,
                Patches& patches) {
  for (Index group = groups.begin; group < groups.end; ++group) fill_group(body, vertex, group, offset, unit, patches);
}

/// A box enlarged by the cutoff. Rounding is monotonic, so that it never hides a box whose gap is at most the cutoff.
class Reach {
 public:
  HWY_INLINE Reach(const Patches::Boxes& boxes, Index box, float cutoff) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo_[axis] = all(boxes.lo[axis][box] - cutoff);
      hi_[axis] = all(boxes.hi[axis][box] + cutoff);
    }
  }
  /// The boxes from `first` on, one in each lane.
  HWY_INLINE M meets(const Patches::Boxes& boxes, Index first) const {
    const auto on = [&](std::size_t axis) HWY_ATTR {
      return hn::And(hn::Le(load(&boxes.lo[axis][first]), hi_[axis]), hn::Le(lo_[axis], load(&boxes.hi[axis][first])));
    };
    return hn::And(hn::And(on(0), on(1)), on(2));
  }

 private:
  V lo_[3], hi_[3];
};

void ListNearGroups(const Patches& patches, Index group, Range others, const KnownPairs* known, Index offset,
                    float cutoff, GroupHits& out) {
  static constexpr KnownPairs::Rows none{};
  if (out.list.size() < others.size() + lanes) out.list.resize(others.size() + lanes);
  const Reach reach(patches.group, group, cutoff);
  ListWriter list(out.list.data());
  for (Index first = others.begin; first < others.end; first += lanes) {
    const M inside = hn::FirstN(Floats(), std::min(lanes, others.end - first));
    list.add(hn::And(inside, reach.meets(patches.group, first)), first, 0);
  }
  out.near.resize(list.size());
  Index k = known ? known->first_group[group - offset] : 0;
  const Index end = known ? known->first_group[group - offset + std::size_t{1}] : 0;
  for (Index n = 0; n < list.size(); ++n) {
    const Index other = out.list[n];
    while (k < end && known->group[k] < other - offset) ++k;
    out.near[n] = {other, k < end && known->group[k] == other - offset ? &known->rows[k] : &none};
  }
}

HWY_INLINE Index near_patches(const Patches& patches, Index patch, float cutoff, GroupHits& out) {
  if (out.list.size() < (out.near.size() + 1) * size) out.list.resize((out.near.size() + 1) * size);
  const Reach reach(patches.patch, patch, cutoff);
  Index count = 0;
  for (std::size_t begin = 0; begin < out.near.size(); begin += 4) {
    std::uint64_t near = 0;  // of four groups: few bits are set
    for (std::size_t k = begin; k < std::min(begin + 4, out.near.size()); ++k) {
      std::uint64_t row = 0;
      for (Index first = 0; first < size; first += lanes)
        row |= bits_of(Floats(), reach.meets(patches.patch, out.near[k].group * size + first)) << first;
      near |= (row & ~std::uint64_t{(*out.near[k].rows)[patch % size]}) << (k - begin) * size;
    }
    for (; near != 0; near &= near - 1) {
      const auto bit = static_cast<Index>(std::countr_zero(near));
      out.list[count++] = out.near[begin + bit / size].group * size + bit % size;
    }
  }
  return count;
}

Index ListNearPatches(const Patches& patches, Index patch, float cutoff, GroupHits& out) {
  return near_patches(patches, patch, cutoff, out);
}

/// All pairs of lanes of two patches, in the order of KnownPairs::Mask: the second lanes from pair `first` on.
HWY_INLINE hn::Vec<Bytes> second_lanes(const std::uint8_t* patch, [[maybe_unused]] std::size_t first) {
#if HWY_TARGET == HWY_SCALAR
  return hn::LoadU(Bytes(), patch + first % size);
#else
  static_assert(byte_lanes % size == 0);
  return hn::LoadDup128(Bytes(), patch);
#endif
}
/// The first lanes.
HWY_INLINE hn::Vec<Bytes> first_lanes(const std::uint8_t* patch, std::size_t first) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(Bytes(), patch[first / size]);
#else
  static constexpr auto row_of_lane = [] {
    std::array<std::uint8_t, 64> rows{};
    for (std::size_t lane = 0; lane < rows.size(); ++lane) rows[lane] = static_cast<std::uint8_t>(lane / size);
    return rows;
  }();
  return hn::TableLookupBytes(
      hn::LoadDup128(Bytes(), patch),
      hn::Add(hn::LoadU(Bytes(), row_of_lane.data()), hn::Set(Bytes(), static_cast<std::uint8_t>(first / size))));
#endif
}

/// ByteUnit::square of differences up to the reach; of others, anything.
HWY_INLINE hn::Vec<Bytes> square_of(const ByteUnit& unit, hn::Vec<Bytes> difference) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(Bytes(), unit.square[hn::GetLane(difference) % unit.square.size()]);
#else
  return hn::TableLookupBytes(hn::LoadDup128(Bytes(), unit.square.data()), difference);
#endif
}

/// The bytes of a patch, each repeated for every lane of another patch, plus `add`.
struct Spread {
  HWY_INLINE Spread(const Patches& patches, Index patch, std::uint8_t add) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t step = 0; step < steps; ++step)
        bytes[axis][step] =
            hn::Add(first_lanes(&patches.bytes[axis][patch * size], step * byte_lanes), hn::Set(Bytes(), add));
  }
  static constexpr std::size_t steps = Patches::group_size / byte_lanes;
  hn::Vec<Bytes> bytes[3][steps];
};

/// The bits of all pairs of two patches for which `test` is true, given the steps of vectors in turn; by words of 64.
template <class Tag, class Test, class Use>
HWY_INLINE void for_words(Tag tag, const Test& test, const Use& use) {
  for (std::size_t word = 0; word < 4; ++word) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 64; k += byte_lanes) bits |= bits_of(tag, test((64 * word + k) / byte_lanes)) << k;
    use(word, bits);
  }
}

/// Appends the hits of a patch with some others, whose numbers count from `offset`. masks: of each of them, if masked.
template <bool masked>
HWY_INLINE void add_hits(const Patches& patches, Index patch, const Spread& same, const Spread& near,
                         const ByteUnit& unit, Index offset, const Index* others, Index count,
                         const KnownPairs::Mask* masks, GroupHits& out, GroupHits::List& list) {
  const auto less = [&](const Spread& spread, Index other, std::size_t axis, std::size_t step) HWY_ATTR {
    return hn::Sub(spread.bytes[axis][step], second_lanes(&patches.bytes[axis][other * size], step * byte_lanes));
  };
  // First the pairs of patches with vertices whose bytes are within reach of each other on all axes.
  if (out.passed.size() < count + std::size_t{1}) out.passed.resize(count + std::size_t{1});
  GroupHits::Passed* passed = out.passed.data();
  std::uint64_t vertices = 0;
  const auto limit = hn::Set(SignedBytes(), std::int8_t{2 * ByteUnit::reach - 128 + 1});
  for (Index n = 0; n < count; ++n) {
    const Index other = offset + others[n];
    vertices += patches.vertices[other];
    std::uint64_t any = 0;
    for_words(
        SignedBytes(),
        [&](std::size_t step) HWY_ATTR {
          const auto on = [&](std::size_t axis)
                              HWY_ATTR { return hn::BitCast(SignedBytes(), less(near, other, axis, step)); };
          return hn::Lt(hn::Max(hn::Max(on(0), on(1)), on(2)), limit);
        },
        [&](std::size_t word, std::uint64_t bits) {
          if (masked) bits &= masks[n][word];
          passed->lanes[word] = bits;
          any |= bits;
        });
    passed->other = other;
    passed += any != 0;  // without a branch: few are
  }
  // Then those of them that may be closer than the cutoff.
  const auto size_now = static_cast<std::size_t>(passed - out.passed.data());
  if (list.hits.size() < list.size + 4 * size_now) list.hits.resize(2 * (list.size + 4 * size_now));
  LaneHits* hits = list.hits.data() + list.size;
  const auto full = hn::Set(Bytes(), ByteUnit::limit);
  for (const GroupHits::Passed& pair : std::span(out.passed).first(size_now)) {
    for_words(
        Bytes(),
        [&](std::size_t step) HWY_ATTR {
          const auto on = [&](std::size_t axis) HWY_ATTR {
            const auto d = hn::BitCast(SignedBytes(), less(same, pair.other, axis, step));
            return square_of(unit, hn::BitCast(Bytes(), hn::Abs(d)));
          };
          return hn::Ne(hn::SaturatedAdd(hn::SaturatedAdd(on(0), on(1)), on(2)), full);
        },
        [&](std::size_t word, std::uint64_t bits) {
          *hits = {Patches::place(patch, static_cast<Index>(4 * word)), Patches::place(pair.other, 0),
                   bits & pair.lanes[word]};
          hits += hits->bits != 0;
        });
  }
  list.size = static_cast<std::size_t>(hits - list.hits.data());
  const std::uint64_t own = patches.vertices[patch];
  out.tested += own * vertices;
  if (count != 0 && offset + others[0] == patch) out.tested -= own * (own + 1) / 2;  // each of its own pairs once
}

/// Lists the pairs of all hits.
HWY_INLINE Index list_hits(GroupHits::List& list) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < list.size; ++n) count += static_cast<std::size_t>(std::popcount(list.hits[n].bits));
  constexpr Index at_once = 3;  // most hits have no more bits
  for (auto* places : {&list.a, &list.b})
    if (places->size() < count + at_once + lanes) places->resize(2 * (count + at_once + lanes));
  Index *const a = list.a.data(), *const b = list.b.data();
  Index pairs = 0;
  for (const LaneHits& hit : std::span(list.hits).first(list.size)) {
    std::uint64_t bits = hit.bits;
    const auto add = [&](Index to) {
      const auto bit = static_cast<Index>(std::countr_zero(bits));
      a[to] = hit.a + bit / Patches::size * Patches::size;
      b[to] = hit.b + bit % Patches::size * Patches::size;
      bits &= bits - 1;
    };
    for (Index k = 0; k < at_once; ++k) {  // without a branch
      const Index more = bits != 0;
      add(pairs);
      pairs += more;
    }
    while (HWY_UNLIKELY(bits != 0)) add(pairs++);
  }
  for (Index k = 0; k < lanes; ++k) a[pairs + k] = b[pairs + k] = 0;
  return pairs;
}

/// Lists the pairs of all hits whose squared_distance() is below tolerance2.
HWY_INLINE void keep_close(const Patches& patches, float tolerance2, GroupHits::List& list) {
  using Places = hn::RebindToSigned<Floats>;
  const Index pairs = list_hits(list);
  Index close = 0;
  for (Index n = 0; n < pairs; n += lanes) {
    const auto places = [&](std::vector<Index>& of)
                            HWY_ATTR { return hn::LoadU(Places(), reinterpret_cast<std::int32_t*>(&of[n])); };
    const auto a = places(list.a), b = places(list.b);
    const auto difference = [&](std::size_t axis) HWY_ATTR {
      const float* const at = patches.at[axis].data();
      return hn::Sub(hn::GatherIndex(Floats(), at, a), hn::GatherIndex(Floats(), at, b));
    };
    const V d2 = squared_length(difference(0), difference(1), difference(2));
    const M near = hn::And(hn::Lt(d2, all(tolerance2)), hn::FirstN(Floats(), std::min(lanes, pairs - n)));
    const auto keep = [&](hn::Vec<Places> some, std::vector<Index>& of) HWY_ATTR {  // what is behind is read already
      hn::StoreU(hn::Compress(some, hn::RebindMask(Places(), near)), Places(),
                 reinterpret_cast<std::int32_t*>(&of[close]));
    };
    keep(a, list.a);
    keep(b, list.b);
    close += static_cast<Index>(hn::CountTrue(Floats(), near));
  }
  list.close = close;
}

void FindGroupHits(const Patches& patches, Index group, const KnownPairs* known, Index offset, float cutoff,
                   const ByteUnit& unit, float tolerance2, GroupHits& out) {
  out.known.size = out.found.size = 0;
  out.tested = 0;
  for (Index patch = group * size; patch < group * size + patches.count[group]; ++patch) {
    const Index local = patch - offset * size, first = known ? known->first_other[local] : 0;
    const Index listed = known ? known->first_other[local + std::size_t{1}] - first : 0;
    const Index near_count = near_patches(patches, patch, cutoff, out);
    if (listed + near_count == 0) continue;
    const Spread same(patches, patch, 0), near(patches, patch, std::uint8_t{ByteUnit::reach + 128});
    if (known) {
      add_hits<true>(patches, patch, same, near, unit, offset * size, known->other.data() + first, listed,
                     known->mask.data() + first, out, out.known);
    }
    add_hits<false>(patches, patch, same, near, unit, 0, out.list.data(), near_count, nullptr, out, out.found);
  }
  for (GroupHits::List* list : {&out.known, &out.found}) keep_close(patches, tolerance2, *list);
}

KnownPairs::Mask ApartAtRest(const std::array<std::vector<float>, 3>& rest, Index a, Index b, float tolerance2) {
  KnownPairs::Mask mask{};
  for (Index first = 0; first < size; first += lanes) {
    const Index at = b * size + first;
    const V x = load(&rest[0][at]), y = load(&rest[1][at]), z = load(&rest[2][at]);
    for (Index k = 0; k < size; ++k) {
      const Index one = a * size + k;
      const V d2 =
          squared_length(hn::Sub(all(rest[0][one]), x), hn::Sub(all(rest[1][one]), y), hn::Sub(all(rest[2][one]), z));
      mask[k / 4] |= bits_of(Floats(), hn::Not(hn::Lt(d2, all(tolerance2)))) << (k % 4 * size + first);
    }
  }
  return mask;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

ByteUnit::ByteUnit(float cutoff) {
  int exponent = 0;
  const double steps = std::ldexp(std::frexp(cutoff, &exponent), 7);  // cutoff P: 64 to 128
  per_metre = std::ldexp(1.0f, 7 - exponent);
  const double most = std::floor(steps) + 1;  // of a difference of q
  factor = static_cast<std::uint32_t>(std::floor(reach * 0x1p24 / most));
  square.fill(limit);
  for (std::size_t n = 0; n <= reach; ++n) {
    const double least = std::max(0.0, (static_cast<double>(n) - 1) * 0x1p24 / factor - 1) / steps;  // of cutoffs
    square[n] = static_cast<std::uint8_t>(std::min(limit - 1.0, std::floor(least * least * limit * (1 - 1e-9))));
  }
}

HWY_EXPORT(FillGroups);
HWY_EXPORT(ListNearGroups);
HWY_EXPORT(ListNearPatches);
HWY_EXPORT(FindGroupHits);
HWY_EXPORT(ApartAtRest);

void fill_groups(const VertexRun& body, const Index* vertex, Range groups, Index offset, const ByteUnit& unit,
                 Patches& patches) {
  HWY_DYNAMIC_DISPATCH(FillGroups)(body, vertex, groups, offset, unit, patches);
}

void list_near_groups(const Patches& patches, Index group, Range others, const KnownPairs* known, Index offset,
                      float cutoff, GroupHits& out) {
  HWY_DYNAMIC_DISPATCH(ListNearGroups)(patches, group, others, known, offset, cutoff, out);
}

Index list_near_patches(const Patches& patches, Index patch, float cutoff, GroupHits& out) {
  return HWY_DYNAMIC_DISPATCH(ListNearPatches)(patches, patch, cutoff, out);
}

void find_group_hits(const Patches& patches, Index group, const KnownPairs* known, Index offset, float cutoff,
                     const ByteUnit& unit, float tolerance2, GroupHits& out) {
  HWY_DYNAMIC_DISPATCH(FindGroupHits)(patches, group, known, offset, cutoff, unit, tolerance2, out);
}

KnownPairs::Mask apart_at_rest(const std::array<std::vector<float>, 3>& rest, Index a, Index b, float tolerance2) {
  return HWY_DYNAMIC_DISPATCH(ApartAtRest)(rest, a, b, tolerance2);
}

void Patches::Boxes::resize(std::size_t boxes) {
  for (auto* bounds : {&lo, &hi})
    for (std::vector<float>& values : *bounds) values.resize(boxes + max_lanes);
}

void Patches::resize(std::size_t groups) {
  for (std::vector<float>& values : at) values.resize(groups * group_size);
  for (std::vector<std::uint8_t>& values : bytes) values.resize(groups * group_size);
  patch.resize(groups * size);
  group.resize(groups);
  count.resize(groups);
  vertices.resize(groups * size);
}

}  // namespace collide::exact
#endif  // HWY_ONCE
