#include "collide/surface/patch_boxes.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/surface/patch_boxes.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide::surface {
namespace HWY_NAMESPACE {
namespace {

using namespace collide::HWY_NAMESPACE;

constexpr Index size = trees::patch_size;
static_assert(size % lanes == 0);

/// Makes boxes behind the last one that meet nothing.
HWY_INLINE void leave_out(BoxColumns& boxes, Index count) {
  for (std::vector<float>& lo : boxes.lo)
    std::fill(lo.begin() + count, lo.end(), std::numeric_limits<float>::quiet_NaN());
}

/// Finds the box around each patch of some boxes. Returns how many patches these are.
HWY_INLINE Index join_boxes(BoxColumns& boxes, Index count, BoxColumns& joint) {
  const Index patches = (count + size - 1) / size;
  joint.resize(patches);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float *const lo = boxes.lo[axis].data(), *const hi = boxes.hi[axis].data();
    std::fill(lo + count, lo + patches * size, lo[count - 1]);
    std::fill(hi + count, hi + patches * size, hi[count - 1]);
    for (Index patch = 0; patch < patches; ++patch) {
      V low = load(lo + patch * size), high = load(hi + patch * size);
      for (Index k = lanes; k < size; k += lanes) {
        low = hn::Min(low, load(lo + patch * size + k));
        high = hn::Max(high, load(hi + patch * size + k));
      }
      joint.lo[axis][patch] = least(low);
      joint.hi[axis][patch] = most(high);
    }
  }
  leave_out(boxes, count);
  return patches;
}

void JoinBoxes(PatchBoxes& boxes) {
  const Index patches = join_boxes(boxes.feature, boxes.features->size(), boxes.patch);
  leave_out(boxes.group, join_boxes(boxes.patch, patches, boxes.group));
}

/// Lists the patches that a patch meets in the groups that its own meets. Returns how many.
HWY_INLINE Index list_patches(const Reach& reach, const PatchBoxes& boxes, Index from, OverlapSearch& own) {
  Index count = 0;
  for (const Index group : own.groups) {
    std::uint64_t near = 0;
    for (Index k = 0; k < size; k += lanes) near |= bits_of(Floats(), reach.meets(boxes.patch, group * size + k)) << k;
    for (; near != 0; near &= near - 1) {
      const Index patch = group * size + static_cast<Index>(std::countr_zero(near));
      own.patches[count] = patch;
      count += patch >= from;
    }
  }
  return count;
}

/// The boxes from `first` on that, moved, meet another box; one in each lane. As Reach, to the bit.
HWY_INLINE M met_by(const BoxColumns& boxes, Index first, const glm::vec3& move_lo, const glm::vec3& move_hi,
                    const BoxColumns& others, Index other) {
  const auto on = [&](std::size_t axis) HWY_ATTR {
    const auto k = static_cast<int>(axis);
    return hn::And(hn::Le(hn::Add(load(&boxes.lo[axis][first]), all(move_lo[k])), all(others.hi[axis][other])),
                   hn::Le(all(others.lo[axis][other]), hn::Add(load(&boxes.hi[axis][first]), all(move_hi[k]))));
  };
  return hn::And(hn::And(on(0), on(1)), on(2));
}

void FindOverlaps(const PatchBoxes& a, Index group, const glm::vec3& move_lo, const glm::vec3& move_hi,
                  const PatchBoxes& b, const JoinedPairs* joined, OverlapSearch& own) {
  static constexpr std::array<std::uint64_t, 4> none{};
  const bool one_list = &a == &b;
  own.groups.resize(b.groups() + lanes);
  ListWriter list(own.groups.data());
  const Reach of_group(a.group, group, move_lo, move_hi);
  for (Index first = one_list ? group : 0; first < b.groups(); first += lanes)
    list.add(of_group.meets(b.group, first), first, 0);
  own.groups.resize(list.size());
  own.patches.resize(list.size() * size + 1);
  for (Index patch = group * size; patch < std::min(a.patches(), (group + 1) * size); ++patch) {
    const Reach of_patch(a.patch, patch, move_lo, move_hi);
    const Index count = list_patches(of_patch, b, one_list ? patch : 0, own);
    if (own.overlaps.size() <= own.used + count * std::size_t{4})
      own.overlaps.resize(2 * own.used + count * std::size_t{4} + 1);
    OverlapSearch::Overlaps* to = &own.overlaps[own.used];
    Index at = joined ? joined->first[patch] : 0;
    const Index end = joined ? joined->first[patch + std::size_t{1}] : 0;
    for (Index n = 0; n < count; ++n) {
      const Index other = own.patches[n];
      while (at < end && joined->patches[at].other < other) ++at;
      const auto& left_out = at < end && joined->patches[at].other == other ? joined->patches[at].pairs : none;
      std::uint64_t rows = 0, bits[4]{};
      for (Index k = 0; k < size; k += lanes)
        rows |= bits_of(Floats(), met_by(a.feature, patch * size + k, move_lo, move_hi, b.patch, other)) << k;
      for (; rows != 0; rows &= rows - 1) {
        const auto k = static_cast<Index>(std::countr_zero(rows));
        const Reach of_feature(a.feature, patch * size + k, move_lo, move_hi);
        std::uint64_t row = 0;
        for (Index first = 0; first < size; first += lanes)
          row |= bits_of(Floats(), of_feature.meets(b.feature, other * size + first)) << first;
        bits[k / 4] |= row << (k % 4 * size);
      }
      for (Index k = 0; k < 4; ++k) {
        bits[k] &= ~left_out[k];
        *to = {patch * size + 4 * k, other * size, bits[k]};
        to += bits[k] != 0;  // without a branch
        own.found += hwy::PopCount(bits[k]);
      }
    }
    own.used = static_cast<std::size_t>(to - own.overlaps.data());
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::surface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::surface {

HWY_EXPORT(JoinBoxes);
HWY_EXPORT(FindOverlaps);

void PatchBoxes::fill(const FeaturePatches& patches_of_features, const Columns& lo, const Columns& hi,
                      std::span<const float> room) {
  features = &patches_of_features;
  const Index count = features->size();
  if (count == 0) return;
  feature.resize(std::size_t{patches()} * trees::patch_size);
  for (Index place = 0; place < count; ++place) {
    const auto& [i, j, k] = features->corners[place];
    const float more = room.empty() ? 0.0f : std::max(std::max(room[i], room[j]), room[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      feature.lo[axis][place] = std::min(std::min(lo[axis][i], lo[axis][j]), lo[axis][k]) - more;
      feature.hi[axis][place] = std::max(std::max(hi[axis][i], hi[axis][j]), hi[axis][k]) + more;
    }
  }
  HWY_DYNAMIC_DISPATCH(JoinBoxes)(*this);
}

void OverlapSearch::find_between(const PatchBoxes& a, const glm::vec3& move_lo, const glm::vec3& move_hi,
                                 const PatchBoxes& b, std::size_t max_pairs) {
  find(a, move_lo, move_hi, b, nullptr, max_pairs);
}

void OverlapSearch::find_within(const PatchBoxes& a, const PatchBoxes& b, const JoinedPairs& joined,
                                std::size_t max_pairs) {
  find(a, glm::vec3(0.0f), glm::vec3(0.0f), b, &joined, max_pairs);
}

void OverlapSearch::find(const PatchBoxes& a, const glm::vec3& move_lo, const glm::vec3& move_hi, const PatchBoxes& b,
                         const JoinedPairs* joined, std::size_t max_pairs) {
  used = found = 0;
  for (Index group = 0; group < a.groups(); ++group) {
    HWY_DYNAMIC_DISPATCH(FindOverlaps)(a, group, move_lo, move_hi, b, joined, *this);
    if (found > max_pairs)
      throw std::length_error("more than " + std::to_string(max_pairs) +
                              " boxes of surface features overlap: move bodies apart or remove some");
  }
}

}  // namespace collide::surface
#endif  // HWY_ONCE
