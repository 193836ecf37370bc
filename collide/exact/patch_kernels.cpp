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

/// Finds the bytes and the box of a patch whose places are filled.
HWY_INLINE void measure_patch(Index patch, const ByteUnit& unit, Patches& patches) {
  const hn::RebindToSigned<Floats> ints;
  const hn::RebindToUnsigned<Floats> words;
  const hn::Rebind<std::uint8_t, Floats> few_bytes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float* const at = &patches.at[axis][patch * size];
    V lo = load(at), hi = lo;
    for (Index first = 0; first < size; first += lanes) {
      const V p = load(at + first);
      lo = hn::Min(lo, p);
      hi = hn::Max(hi, p);
      const auto q = hn::BitCast(words, hn::ConvertTo(ints, hn::Mul(p, all(unit.per_metre))));
      hn::StoreU(hn::TruncateTo(few_bytes, hn::ShiftRight<24>(hn::Mul(q, hn::Set(words, unit.factor)))), few_bytes,
                 &patches.bytes[axis][patch * size + first]);
    }
    patches.patch.lo[axis][patch] = least(lo);
    patches.patch.hi[axis][patch] = most(hi);
    for (Index k = patches.vertices[patch]; k < size; ++k) at[k] = std::numeric_limits<float>::quiet_NaN();
  }
}

HWY_INLINE void fill_group(const VertexRun& body, const Index* vertex, Index group, Index offset, const ByteUnit& unit,
                           Patches& patches) {
  const Index to = (offset + group) * size, from = group * size;
  const Index count = std::min(size, (body.size + size - 1) / size - from);
  patches.count[offset + group] = count;
  float *const x = &patches.at[0][to * size], *const y = &patches.at[1][to * size];
  float* const z = &patches.at[2][to * size];
  for (Index k = 0; k < count * size; ++k) {  // all of them, before vectors read what single values have written
    const Index v = vertex[from * size + k];
    x[k] = body.x[v];
    y[k] = body.y[v];
    z[k] = body.z[v];
  }
  for (Index k = 0; k < count; ++k) {
    patches.vertices[to + k] = std::min(size, body.size - (from + k) * size);
    measure_patch(to + k, unit, patches);
  }
  const float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float *const lo = &patches.patch.lo[axis][to], *const hi = &patches.patch.hi[axis][to];
    std::fill(lo + count, lo + size, infinity);
    std::fill(hi + count, hi + size, -infinity);
    V least_lo = load(lo), most_hi = load(hi);
    for (Index first = lanes; first < size; first += lanes) {
      least_lo = hn::Min(least_lo, load(lo + first));
      most_hi = hn::Max(most_hi, load(hi + first));
    }
    patches.group.lo[axis][offset + group] = least(least_lo);
    patches.group.hi[axis][offset + group] = most(most_hi);
  }
}

void FillGroups(const VertexRun& body, const Index* vertex, Range groups, Index offset, const ByteUnit& unit,
                Patches& patches) {
  for (Index group = groups.begin; group < groups.end; ++group) fill_group(body, vertex, group, offset, unit, patches);
}

void ListNearGroups(const Patches& patches, Index group, Range others, const KnownPairs* known, Index offset,
                    float cutoff, GroupHits& out) {
  static constexpr KnownPairs::Rows none{};
  if (out.list.size() < others.size() + lanes) out.list.resize(others.size() + lanes);
  const Reach reach(patches.group, group, glm::vec3(-cutoff), glm::vec3(cutoff));
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

HWY_INLINE Index ListNearPatches(const Patches& patches, Index patch, float cutoff, GroupHits& out) {
  if (out.list.size() < (out.near.size() + 1) * size) out.list.resize((out.near.size() + 1) * size);
  const Reach reach(patches.patch, patch, glm::vec3(-cutoff), glm::vec3(cutoff));
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

/// The bytes of a patch, each repeated for every lane of another patch, moved so that those within reach of another
/// byte are the least.
struct Spread {
  HWY_INLINE Spread(const Patches& patches, Index patch) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t step = 0; step < steps; ++step)
        bytes[axis][step] = hn::Add(first_lanes(&patches.bytes[axis][patch * size], step * byte_lanes),
                                    hn::Set(Bytes(), std::uint8_t{ByteUnit::reach + 128}));
  }
  static constexpr std::size_t steps = Patches::group_size / byte_lanes;
  hn::Vec<Bytes> bytes[3][steps];
};

/// Returns which pairs of the four vertices from place a on and the patch at place b have a squared_distance() below
/// tolerance2. at: m, by place.
HWY_INLINE std::uint64_t close_lanes(const std::array<std::vector<float>, 3>& at, Index a, Index b, float tolerance2) {
  const float *const x = at[0].data(), *const y = at[1].data(), *const z = at[2].data();
  const V limit = all(tolerance2);
  std::uint64_t close = 0;
  for (Index first = 0; first < size; first += lanes) {
    const V bx = load(x + b + first), by = load(y + b + first), bz = load(z + b + first);
    const auto row = [&](Index k) HWY_ATTR {
      const V d2 = squared_length(hn::Sub(all(x[a + k]), bx), hn::Sub(all(y[a + k]), by), hn::Sub(all(z[a + k]), bz));
      return bits_of(Floats(), hn::Lt(d2, limit)) << (k * size + first);
    };
    close |= row(0) | row(1) | row(2) | row(3);
  }
  return close;
}

/// Appends the close pairs of a patch with some others, whose numbers count from `offset`. masks: of each of them, if
/// masked.
template <bool masked>
HWY_INLINE void add_hits(const Patches& patches, Index patch, const Spread& spread, Index offset, const Index* others,
                         Index count, const KnownPairs::Mask* masks, float tolerance2, GroupHits& out,
                         std::vector<std::array<Index, 2>>& hits) {
  // First the vertices whose bytes are within reach of each other on all axes.
  if (out.passed.size() < 4 * count + std::size_t{1}) out.passed.resize(4 * count + std::size_t{1});
  GroupHits::Passed* passed = out.passed.data();
  std::uint64_t vertices = 0;
  const auto limit = hn::Set(SignedBytes(), std::int8_t{2 * ByteUnit::reach - 128 + 1});
  for (Index n = 0; n < count; ++n) {
    const Index other = offset + others[n];
    vertices += patches.vertices[other];
    for (Index word = 0; word < 4; ++word) {
      std::uint64_t bits = 0;
      for (std::size_t k = 0; k < 64; k += byte_lanes) {
        const std::size_t pair = 64 * word + k;
        const auto on = [&](std::size_t axis) HWY_ATTR {
          const auto bytes = second_lanes(&patches.bytes[axis][other * size], pair);
          return hn::BitCast(SignedBytes(), hn::Sub(spread.bytes[axis][pair / byte_lanes], bytes));
        };
        bits |= bits_of(SignedBytes(), hn::Lt(hn::Max(hn::Max(on(0), on(1)), on(2)), limit)) << k;
      }
      if (masked) bits &= masks[n][word];
      *passed = {patch * size + 4 * word, other * size, bits};
      passed += bits != 0;  // without a branch: few are
    }
  }
  // Then those of them that are close.
  for (const auto& [a, b, lanes_passed] : std::span(out.passed.data(), passed)) {
    for (std::uint64_t bits = lanes_passed & close_lanes(patches.at, a, b, tolerance2); bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<Index>(std::countr_zero(bits));
      hits.push_back({a + bit / size, b + bit % size});
    }
  }
  const std::uint64_t own = patches.vertices[patch];
  out.tested += own * vertices;
  if (count != 0 && offset + others[0] == patch) out.tested -= own * (own + 1) / 2;  // each of its own pairs once
}

void FindGroupHits(const Patches& patches, Index group, const KnownPairs* known, Index offset, float cutoff,
                   float tolerance2, GroupHits& out) {
  out.known.clear();
  out.found.clear();
  out.tested = 0;
  for (Index patch = group * size; patch < group * size + patches.count[group]; ++patch) {
    const Index local = patch - offset * size, first = known ? known->first_other[local] : 0;
    const Index listed = known ? known->first_other[local + std::size_t{1}] - first : 0;
    const Index near_count = ListNearPatches(patches, patch, cutoff, out);
    if (listed + near_count == 0) continue;
    const Spread spread(patches, patch);
    if (known) {
      add_hits<true>(patches, patch, spread, offset * size, known->other.data() + first, listed,
                     known->mask.data() + first, tolerance2, out, out.known);
    }
    add_hits<false>(patches, patch, spread, 0, out.list.data(), near_count, nullptr, tolerance2, out, out.found);
  }
}

KnownPairs::Mask ClosePairs(const std::array<std::vector<float>, 3>& at, Index a, Index b, float tolerance2) {
  KnownPairs::Mask close;
  for (Index word = 0; word < 4; ++word) close[word] = close_lanes(at, a * size + 4 * word, b * size, tolerance2);
  return close;
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
}

HWY_EXPORT(FillGroups);
HWY_EXPORT(ListNearGroups);
HWY_EXPORT(ListNearPatches);
HWY_EXPORT(FindGroupHits);
HWY_EXPORT(ClosePairs);

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
                     float tolerance2, GroupHits& out) {
  HWY_DYNAMIC_DISPATCH(FindGroupHits)(patches, group, known, offset, cutoff, tolerance2, out);
}

KnownPairs::Mask close_pairs(const std::array<std::vector<float>, 3>& at, Index a, Index b, float tolerance2) {
  return HWY_DYNAMIC_DISPATCH(ClosePairs)(at, a, b, tolerance2);
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
