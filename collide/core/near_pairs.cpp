#include "collide/core/near_pairs.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/core/near_pairs.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide {
namespace HWY_NAMESPACE {
namespace {

/// Vertices in a block. Blocks may run past the end of a run, into slots that are then left out.
template <class Tag>
struct Block {
  hn::Vec<Tag> x, y, z;
};

template <class Tag>
HWY_INLINE Block<Tag> block_at(Tag tag, const Points& points, Index first) {
  return {hn::LoadU(tag, &points.x[first]), hn::LoadU(tag, &points.y[first]), hn::LoadU(tag, &points.z[first])};
}

template <class Tag>
HWY_INLINE hn::Mask<Tag> close(Tag tag, const Points& points, Index i, const Block<Tag>& block, float tolerance2) {
  const auto dx = hn::Sub(hn::Set(tag, points.x[i]), block.x), dy = hn::Sub(hn::Set(tag, points.y[i]), block.y),
             dz = hn::Sub(hn::Set(tag, points.z[i]), block.z);
  return hn::Lt(squared_length(dx, dy, dz), hn::Set(tag, tolerance2));
}

template <class Tag>
HWY_INLINE void append(Tag tag, hn::Mask<Tag> mask, Index i, Index first, Index end, std::vector<SlotPair>& hits) {
  for (std::uint64_t bits = bits_of(tag, mask); bits != 0; bits &= bits - 1) {
    const Index j = first + static_cast<Index>(std::countr_zero(bits));
    if (j < end) hits.push_back({i, j});
  }
}

void NearPairs(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits) {
  const Floats tag;
  for (Index i = a.begin; i < a.end; ++i) {
    for (Index j = std::max(b.begin, i + 1); j < b.end; j += lanes) {
      const M mask = close(tag, points, i, block_at(tag, points, j), tolerance2);
      if (HWY_UNLIKELY(!hn::AllFalse(tag, mask))) append(tag, mask, i, j, b.end, hits);
    }
  }
}

/// Block by block, each against all of a: contacts are rare, so a block first answers "any at all?".
void NearRuns(const Points& points, Range a, std::span<const Range> runs, float tolerance2,
              std::vector<SlotPair>& hits) {
  const hn::CappedTag<float, 8> tag;  // runs are short
  const auto step = static_cast<Index>(hn::Lanes(tag));
  for (const Range run : runs) {
    for (Index j = run.begin; j < run.end; j += step) {
      const auto block = block_at(tag, points, j);
      auto any = close(tag, points, a.begin, block, tolerance2);
      for (Index i = a.begin + 1; i < a.end; ++i) any = hn::Or(any, close(tag, points, i, block, tolerance2));
      if (HWY_LIKELY(hn::AllFalse(tag, any))) continue;
      for (Index i = a.begin; i < a.end; ++i) {
        append(tag, close(tag, points, i, block, tolerance2), i, j, run.end, hits);
      }
    }
  }
}

Index NearPairsInBox(const Points& points, Range a, Range b, const Aabb& box, float cutoff, float tolerance2,
                     std::vector<SlotPair>& hits) {
  const Floats tag;
  const V limit = all(cutoff);
  const auto within = [limit](V at, float lo, float hi) HWY_ATTR {  // as near()
    return hn::And(hn::Le(hn::Sub(at, all(hi)), limit), hn::Le(hn::Sub(all(lo), at), limit));
  };
  Index rows = 0;
  for (Index first = a.begin; first < a.end; first += lanes) {
    const Block<Floats> block = block_at(tag, points, first);
    const M near =
        hn::And(hn::And(within(block.x, box.lo.x, box.hi.x), within(block.y, box.lo.y, box.hi.y)),
                hn::And(within(block.z, box.lo.z, box.hi.z), hn::FirstN(tag, std::min(lanes, a.end - first))));
    for (std::uint64_t bits = bits_of(tag, near); bits != 0; bits &= bits - 1) {
      const Index i = first + static_cast<Index>(std::countr_zero(bits));
      ++rows;
      for (Index j = b.begin; j < b.end; j += lanes) {
        const M mask = close(tag, points, i, block_at(tag, points, j), tolerance2);
        if (HWY_UNLIKELY(!hn::AllFalse(tag, mask))) append(tag, mask, i, j, b.end, hits);
      }
    }
  }
  return rows;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide {

HWY_EXPORT(NearPairs);
HWY_EXPORT(NearRuns);
HWY_EXPORT(NearPairsInBox);

void near_pairs(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits) {
  HWY_DYNAMIC_DISPATCH(NearPairs)(points, a, b, tolerance2, hits);
}

void near_pairs(const Points& points, Range a, std::span<const Range> runs, float tolerance2,
                std::vector<SlotPair>& hits) {
  HWY_DYNAMIC_DISPATCH(NearRuns)(points, a, runs, tolerance2, hits);
}

Index near_pairs(const Points& points, Range a, Range b, const Aabb& box_of_b, float cutoff, float tolerance2,
                 std::vector<SlotPair>& hits) {
  return HWY_DYNAMIC_DISPATCH(NearPairsInBox)(points, a, b, box_of_b, cutoff, tolerance2, hits);
}

}  // namespace collide
#endif  // HWY_ONCE
