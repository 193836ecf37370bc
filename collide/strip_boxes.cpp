#include "collide/strip_boxes.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/strip_boxes.cpp"
#include <hwy/foreach_target.h>

#include "collide/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide {
namespace HWY_NAMESPACE {
namespace {

Index SweepStrip(const StripBoxes& boxes, Index i, Index begin, Index end, float reach, std::vector<Index>& found) {
  const V limit = all(reach);
  const auto along = static_cast<std::size_t>(boxes.along), side = (along + 1) % 3, other = (along + 2) % 3;
  const V lo0 = all(boxes.lo[along][i]), hi0 = all(boxes.hi[along][i]);
  const V lo1 = all(boxes.lo[side][i]), hi1 = all(boxes.hi[side][i]);
  const V lo2 = all(boxes.lo[other][i]), hi2 = all(boxes.hi[other][i]);
  const V c0 = all(boxes.centre[0][i]), c1 = all(boxes.centre[1][i]), c2 = all(boxes.centre[2][i]);
  const V radius = all(boxes.radius[i] + reach);
  Index near_boxes = 0;
  for (Index j = begin; j < end; j += lanes) {
    // Lanes beyond the strip belong to the next one.
    const M inside = hn::FirstN(Floats(), std::min(lanes, end - j));
    const M within = hn::And(inside, hn::Le(hn::Sub(load(&boxes.lo[along][j]), hi0), limit));  // a prefix of the block
    const M near0 = hn::And(within, hn::Le(hn::Sub(lo0, load(&boxes.hi[along][j])), limit));
    const M near1 = hn::And(hn::Le(hn::Sub(load(&boxes.lo[side][j]), hi1), limit),
                            hn::Le(hn::Sub(lo1, load(&boxes.hi[side][j])), limit));
    const M near2 = hn::And(hn::Le(hn::Sub(load(&boxes.lo[other][j]), hi2), limit),
                            hn::Le(hn::Sub(lo2, load(&boxes.hi[other][j])), limit));
    const M near = hn::And(near0, hn::And(near1, near2));
    if (!hn::AllFalse(Floats(), near)) {
      const V d2 = squared_length(hn::Sub(load(&boxes.centre[0][j]), c0), hn::Sub(load(&boxes.centre[1][j]), c1),
                                  hn::Sub(load(&boxes.centre[2][j]), c2));
      // A relative margin for the rounding of both sides, an absolute one for their underflow; overflow makes both inf.
      const V reached = hn::Add(radius, load(&boxes.radius[j]));
      const V most2 = hn::Add(hn::Mul(hn::Mul(reached, reached), all(1 + 0x1p-18f)), all(1e-37f));
      near_boxes += static_cast<Index>(hn::CountTrue(Floats(), near));
      for (std::uint64_t bits = bits_of(hn::And(near, hn::Not(hn::Gt(d2, most2)))); bits != 0; bits &= bits - 1) {
        found.push_back(j + static_cast<Index>(std::countr_zero(bits)));
      }
    }
    if (!hn::AllTrue(Floats(), within)) break;
  }
  return near_boxes;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide {

HWY_EXPORT(SweepStrip);

Index sweep_strip(const StripBoxes& boxes, Index i, Index begin, Index end, float reach, std::vector<Index>& found) {
  return HWY_DYNAMIC_DISPATCH(SweepStrip)(boxes, i, begin, end, reach, found);
}

void StripBoxes::resize(Index count) {
  size = count;
  for (auto* bounds : {&lo, &hi, &centre}) {
    for (auto& values : *bounds) values.resize(std::size_t{count} + most_lanes);
  }
  radius.resize(std::size_t{count} + most_lanes);
}

}  // namespace collide
#endif  // HWY_ONCE
