// What the vectorised loops share: Highway's vectors of floats, blocks of vertices, and lists of vertices. It is
// compiled once for each of Highway's targets: include it after <hwy/foreach_target.h>. This include guard is
// Highway's.
#if defined(COLLIDE_SIMD_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef COLLIDE_SIMD_LANES_H
#undef COLLIDE_SIMD_LANES_H
#else
#define COLLIDE_SIMD_LANES_H
#endif

#include <array>
#include <cmath>

#include <hwy/highway.h>

#include "collide/core/vertex_run.h"

HWY_BEFORE_NAMESPACE();
namespace collide {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Index lanes = static_cast<Index>(hn::MaxLanes(Floats()));
static_assert(lanes <= max_lanes && 64 % lanes == 0);

HWY_INLINE V load(const float* at) { return hn::LoadU(Floats(), at); }
HWY_INLINE V all(float value) { return hn::Set(Floats(), value); }

template <class Tag>
HWY_INLINE std::uint64_t bits_of(Tag tag, hn::Mask<Tag> mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(tag, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

/// Calls block(first, skip) for blocks of lanes that cover 0 .. size - 1. The last block ends with the last vertex, so
/// it may overlap the block before it: its first `skip` lanes were in that block already. `first` is negative if there
/// are fewer vertices than lanes.
template <class Block>
HWY_INLINE void for_blocks(Index size, const Block& block) {
  Index i = 0;
  for (; i + lanes <= size; i += lanes) block(static_cast<std::ptrdiff_t>(i), 0u);
  if (i < size) block(static_cast<std::ptrdiff_t>(size) - static_cast<std::ptrdiff_t>(lanes), lanes - (size - i));
}

/// Memory for readable().
struct Copy {
  float x[lanes], y[lanes], z[lanes];
};

/// Returns a run that for_blocks() may read: the run itself, or, if it has fewer vertices than lanes, a copy that
/// starts with repetitions of the first vertex.
HWY_INLINE VertexRun readable(const VertexRun& run, Copy& copy) {
  if (HWY_LIKELY(run.size >= lanes)) return run;
  const Index skip = lanes - run.size;
  for (Index lane = 0; lane < lanes; ++lane) {
    const Index v = lane < skip ? 0 : lane - skip;
    copy.x[lane] = run.x[v];
    copy.y[lane] = run.y[v];
    copy.z[lane] = run.z[v];
  }
  return {copy.x + skip, copy.y + skip, copy.z + skip, run.size};
}

template <class Vector>
HWY_INLINE Vector squared_length(Vector x, Vector y, Vector z) {  // as squared_distance()
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

/// For each byte, the numbers of its set bits; ascending, without gaps.
constexpr auto numbers_of_bits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t bits = 0; bits < table.size(); ++bits) {
    std::size_t size = 0;
    for (std::uint8_t bit = 0; bit < 8; ++bit) {
      if (bits >> bit & 1) table[bits][size++] = bit;
    }
  }
  return table;
}();

/// Appends the numbers of selected lanes to a list. It writes whole blocks, so the list needs room for one more block.
class ListWriter {
 public:
  explicit ListWriter(Index* list) : list_(list) {}
  /// Appends the numbers of the lanes in the mask, without the first `skip` lanes. first: the number of the first lane.
  HWY_INLINE void add(M mask, std::ptrdiff_t first, Index skip) {
    if (skip != 0) mask = hn::AndNot(hn::FirstN(Floats(), skip), mask);
    hn::StoreU(hn::Add(first_lanes(mask), hn::Set(Numbers(), static_cast<Index>(first))), Numbers(), list_ + size_);
    size_ += static_cast<Index>(hn::CountTrue(Floats(), mask));
  }
  Index size() const { return size_; }

 private:
  using Numbers = hn::RebindToUnsigned<Floats>;
  using Bytes = hn::Rebind<std::uint8_t, Numbers>;

  HWY_INLINE hn::Vec<Numbers> first_lanes(M mask) const {
    if constexpr (lanes > 8) {
      return hn::Compress(lane_, hn::RebindMask(Numbers(), mask));
    } else {  // without an instruction for it
      return hn::PromoteTo(Numbers(), hn::LoadU(Bytes(), numbers_of_bits[bits_of(Floats(), mask)].data()));
    }
  }

  hn::Vec<Numbers> lane_ = hn::Iota(Numbers(), 0);
  Index* list_;
  Index size_ = 0;
};

/// A box whose corners are moved by some vectors. Rounding is monotonic, so that it never hides a box that the moved
/// one overlaps.
class Reach {
 public:
  HWY_INLINE Reach(const BoxColumns& boxes, Index box, const glm::vec3& move_lo, const glm::vec3& move_hi) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo_[axis] = all(boxes.lo[axis][box] + move_lo[static_cast<int>(axis)]);
      hi_[axis] = all(boxes.hi[axis][box] + move_hi[static_cast<int>(axis)]);
    }
  }
  /// The boxes from `first` on, one in each lane.
  HWY_INLINE M meets(const BoxColumns& boxes, Index first) const {
    const auto on = [&](std::size_t axis) HWY_ATTR {
      return hn::And(hn::Le(load(&boxes.lo[axis][first]), hi_[axis]), hn::Le(lo_[axis], load(&boxes.hi[axis][first])));
    };
    return hn::And(hn::And(on(0), on(1)), on(2));
  }

 private:
  V lo_[3], hi_[3];
};

HWY_INLINE float least(V v) { return hn::GetLane(hn::MinOfLanes(Floats(), v)); }
HWY_INLINE float most(V v) { return hn::GetLane(hn::MaxOfLanes(Floats(), v)); }
HWY_INLINE float sum(V v) { return hn::GetLane(hn::SumOfLanes(Floats(), v)); }

/// Returns a bound of the true length, given its square as squared_length() computes it: the factor covers four units
/// of rounding, the sum covers what products lose by underflow.
HWY_INLINE float root_above(float squared) {
  return static_cast<float>(std::sqrt(double{squared} + 0x1p-147) * (1 + 0x1p-21));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide
HWY_AFTER_NAMESPACE();

#endif  // include guard
