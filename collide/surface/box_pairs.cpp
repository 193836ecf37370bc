#include "collide/surface/box_pairs.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>

#include "collide/core/aabb.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/surface/box_pairs.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace collide::surface {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Writes one bit for each box k >= begin: set if it overlaps `box`. begin: a multiple of 64.
void Overlapping(const BoxList& list, Index begin, const Aabb& box, std::uint64_t* words) {
  const hn::ScalableTag<float> d;
  constexpr auto lanes = static_cast<Index>(hn::MaxLanes(d));
  static_assert(lanes <= BoxList::padding && 64 % lanes == 0);
  for (Index first = begin; first < list.size; first += 64) {
    std::uint64_t word = 0;
    for (Index k = 0; k < 64 && first + k < list.size; k += lanes) {
      auto apart = hn::Gt(hn::Set(d, box.lo.x), hn::LoadU(d, &list.hi[0][first + k]));
      apart = hn::Or(apart, hn::Gt(hn::LoadU(d, &list.lo[0][first + k]), hn::Set(d, box.hi.x)));
      apart = hn::Or(apart, hn::Gt(hn::Set(d, box.lo.y), hn::LoadU(d, &list.hi[1][first + k])));
      apart = hn::Or(apart, hn::Gt(hn::LoadU(d, &list.lo[1][first + k]), hn::Set(d, box.hi.y)));
      apart = hn::Or(apart, hn::Gt(hn::Set(d, box.lo.z), hn::LoadU(d, &list.hi[2][first + k])));
      apart = hn::Or(apart, hn::Gt(hn::LoadU(d, &list.lo[2][first + k]), hn::Set(d, box.hi.z)));
      std::uint64_t bits = 0;
      hn::StoreMaskBits(d, hn::Not(apart), reinterpret_cast<std::uint8_t*>(&bits));
      word |= bits << k;
    }
    words[(first - begin) / 64] = word;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace collide::surface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::surface {
namespace {

HWY_EXPORT(Overlapping);

/// Calls visit(k) for each box k >= begin that overlaps `box`.
template <class Visit>
void for_overlapping(const BoxList& list, Index begin, const Aabb& box, std::vector<std::uint64_t>& words,
                     const Visit& visit) {
  if (begin >= list.size) return;
  const Index start = begin / 64 * 64, count = (list.size - start + 63) / 64;
  if (words.size() < count) words.resize(count);
  HWY_DYNAMIC_DISPATCH(Overlapping)(list, start, box, words.data());
  words[0] &= ~std::uint64_t{0} << (begin - start);
  for (Index w = 0; w < count; ++w)
    for (std::uint64_t word = words[w]; word != 0; word &= word - 1)
      visit(start + 64 * w + static_cast<Index>(std::countr_zero(word)));
}

/// Copies the boxes of one side of a cut; a box on both sides belongs to both.
void filter_side(const BoxList& list, const MidpointCut& cut, bool low, BoxList& side) {
  const auto axis = static_cast<std::size_t>(cut.axis);
  side.clear();
  side.reserve(list.size);
  for (Index k = 0; k < list.size; ++k)
    if (low ? list.lo[axis][k] < cut.mid : list.hi[axis][k] >= cut.mid) side.add(list.box(k), list.item[k]);
  side.end();
}

/// Returns the minimum corner of the cell above a cut, given that of the whole cell.
glm::vec3 above(glm::vec3 cell_lo, const MidpointCut& cut) {
  cell_lo[cut.axis] = std::max(cell_lo[cut.axis], cut.mid);
  return cell_lo;
}

constexpr std::size_t max_depth = 48;
const glm::vec3 lowest_corner(std::numeric_limits<float>::lowest());

}  // namespace

void BoxList::reserve(Index count) {
  const std::size_t wanted = std::size_t{count} + padding;
  if (item.size() >= wanted) return;
  for (auto* side : {&lo, &hi})
    for (auto& values : *side) values.resize(wanted);
  item.resize(wanted);
}

void BoxList::add(const Aabb& box, Index i) {
  assert(size < item.size());
  for (int axis = 0; axis < 3; ++axis) {
    lo[static_cast<std::size_t>(axis)][size] = box.lo[axis];
    hi[static_cast<std::size_t>(axis)][size] = box.hi[axis];
  }
  item[size++] = i;
}

void BoxList::end() {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index k = size; k < size + padding; ++k) {
      lo[axis][k] = std::numeric_limits<float>::max();
      hi[axis][k] = std::numeric_limits<float>::lowest();
    }
}

Aabb BoxList::bounds() const {
  assert(size > 0);
  Aabb all = box(0);
  for (Index k = 1; k < size; ++k) all = joint(all, box(k));
  return all;
}

void BoxPairs::pick(const BoxList& list, const Aabb& box, BoxList& picked) {
  picked.clear();
  picked.reserve(list.size);
  for_overlapping(list, 0, box, words_, [&](Index k) { picked.add(list.box(k), list.item[k]); });
  picked.end();
}

void BoxPairs::between(const BoxList& a, const BoxList& b, std::vector<ItemPair>& pairs, std::size_t max_pairs) {
  assert(&a != &b);
  pairs_ = &pairs;
  max_pairs_ = max_pairs;
  cut(a, b, lowest_corner, 0);
}

void BoxPairs::within(const BoxList& list, std::vector<ItemPair>& pairs, std::size_t max_pairs) {
  pairs_ = &pairs;
  max_pairs_ = max_pairs;
  cut(list, list, lowest_corner, 0);
}

/// Appends the pairs of box i of a with the boxes k >= begin of b. A pair belongs to the cell that contains the minimum
/// corner of the overlap, so that a pair that several cells see is appended once. cell_lo: the minimum corner of this
/// cell. Its maximum corner needs no test, since every box in its lists begins below that.
void BoxPairs::test(const BoxList& a, Index i, const BoxList& b, Index begin, const glm::vec3& cell_lo) {
  const Aabb box = a.box(i);
  for_overlapping(b, begin, box, words_, [&](Index k) {
    const glm::vec3 corner = glm::max(box.lo, b.box(k).lo);
    if (corner.x >= cell_lo.x && corner.y >= cell_lo.y && corner.z >= cell_lo.z)
      pairs_->push_back({a.item[i], b.item[k]});
  });
  if (pairs_->size() > max_pairs_)
    throw std::length_error("more than " + std::to_string(max_pairs_) +
                            " boxes of surface features overlap: move bodies apart or remove some");
}

BoxPairs::Level& BoxPairs::level(std::size_t depth) {
  while (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
  return *levels_[depth];
}

void BoxPairs::cut(const BoxList& a, const BoxList& b, const glm::vec3& cell_lo, std::size_t depth) {
  const bool within = &a == &b;
  const auto tests = [&](const BoxList& one, const BoxList& other) {
    return std::uint64_t{one.size} * other.size / (within ? 2 : 1);
  };
  if (tests(a, b) > leaf_tests && depth < max_depth) {
    const MidpointCut cut_here = cut_of(a.bounds());
    Level& own = level(depth);
    filter_side(a, cut_here, true, own.low_a);
    filter_side(a, cut_here, false, own.up_a);
    if (!within) {
      filter_side(b, cut_here, true, own.low_b);
      filter_side(b, cut_here, false, own.up_b);
    }
    const BoxList &low_b = within ? own.low_a : own.low_b, &up_b = within ? own.up_a : own.up_b;
    if (tests(own.low_a, low_b) + tests(own.up_a, up_b) < tests(a, b) / 8 * 7) {
      cut(own.low_a, low_b, cell_lo, depth + 1);
      cut(own.up_a, up_b, above(cell_lo, cut_here), depth + 1);
      return;
    }
  }
  for (Index i = 0; i < a.size; ++i) test(a, i, b, within ? i + 1 : 0, cell_lo);
}

}  // namespace collide::surface
#endif  // HWY_ONCE
