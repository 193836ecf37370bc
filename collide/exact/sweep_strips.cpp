#include "collide/exact/sweep_strips.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/exact/sweep_strips.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide::exact {
namespace HWY_NAMESPACE {
namespace {

using namespace collide::HWY_NAMESPACE;

Index SweepStrip(const SweepStrips& boxes, Index i, Index begin, Index end, float cutoff, std::vector<Index>& found) {
  const V limit = all(cutoff);
  const V lo0 = all(boxes.lo[0][i]), lo1 = all(boxes.lo[1][i]), lo2 = all(boxes.lo[2][i]);
  const V hi0 = all(boxes.hi[0][i]), hi1 = all(boxes.hi[1][i]), hi2 = all(boxes.hi[2][i]);
  const V c0 = all(boxes.centre[0][i]), c1 = all(boxes.centre[1][i]), c2 = all(boxes.centre[2][i]);
  const V radius = all(boxes.radius[i] + cutoff);
  Index near_box_pairs = 0;
  for (Index j = begin; j < end; j += lanes) {
    const auto within = [&](V lo, V hi, std::size_t axis) HWY_ATTR {
      return hn::And(hn::Le(hn::Sub(load(&boxes.lo[axis][j]), hi), limit),
                     hn::Le(hn::Sub(lo, load(&boxes.hi[axis][j])), limit));
    };
    const M inside = hn::FirstN(Floats(), std::min(lanes, end - j));  // lanes beyond the end belong to other boxes
    const M near = hn::And(hn::And(inside, within(lo0, hi0, 0)), hn::And(within(lo1, hi1, 1), within(lo2, hi2, 2)));
    if (!hn::AllFalse(Floats(), near)) {
      const V d2 = squared_length(hn::Sub(load(&boxes.centre[0][j]), c0), hn::Sub(load(&boxes.centre[1][j]), c1),
                                  hn::Sub(load(&boxes.centre[2][j]), c2));
      // A relative margin for the rounding of both sides, an absolute one for their underflow; overflow makes both inf.
      const V reached = hn::Add(radius, load(&boxes.radius[j]));
      const V most2 = hn::Add(hn::Mul(hn::Mul(reached, reached), all(1 + 0x1p-18f)), all(1e-37f));
      near_box_pairs += static_cast<Index>(hn::CountTrue(Floats(), near));
      for (std::uint64_t bits = bits_of(Floats(), hn::And(near, hn::Not(hn::Gt(d2, most2)))); bits != 0;
           bits &= bits - 1) {
        found.push_back(j + static_cast<Index>(std::countr_zero(bits)));
      }
    }
  }
  return near_box_pairs;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

HWY_EXPORT(SweepStrip);

Index sweep_strip(const SweepStrips& boxes, Index i, Index begin, Index end, float cutoff, std::vector<Index>& found) {
  return HWY_DYNAMIC_DISPATCH(SweepStrip)(boxes, i, begin, end, cutoff, found);
}

void SweepStrips::resize(Index count) {
  for (auto* bounds : {&lo, &hi, &centre}) {
    for (auto& values : *bounds) values.resize(std::size_t{count} + max_lanes);
  }
  radius.resize(std::size_t{count} + max_lanes);
}

}  // namespace collide::exact
#endif  // HWY_ONCE
