#include "collide/exact/patch_kernels.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/exact/patch_kernels.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide::exact {
namespace HWY_NAMESPACE {
namespace {

using namespace collide::HWY_NAMESPACE;

/// Bounds of squared_distance() between what lies in two intervals on each axis, which may be points. Each of its steps
/// rounds monotonically, so that the bounds need no margin.
struct Interval {
  V lo, hi;
};
HWY_INLINE V gap(Interval a, Interval b) {
  return hn::Max(hn::Max(hn::Sub(a.lo, b.hi), hn::Sub(b.lo, a.hi)), hn::Zero(Floats()));
}
HWY_INLINE V span_of(Interval a, Interval b) { return hn::Max(hn::Sub(a.hi, b.lo), hn::Sub(b.hi, a.lo)); }

using Box = std::array<Interval, 3>;
HWY_INLINE M is_near(const Box& a, const Box& b, V limit) {
  return hn::Lt(squared_length(gap(a[0], b[0]), gap(a[1], b[1]), gap(a[2], b[2])), limit);
}
HWY_INLINE M is_excluded(const Box& a, const Box& b, V limit) {
  return hn::Lt(squared_length(span_of(a[0], b[0]), span_of(a[1], b[1]), span_of(a[2], b[2])), limit);
}

using Coordinates = std::array<std::vector<float>, 3>;
/// Returns the box of one patch, in every lane.
HWY_INLINE Box box_of(const Coordinates& lo, const Coordinates& hi, Index patch) {
  return {Interval{all(lo[0][patch]), all(hi[0][patch])}, Interval{all(lo[1][patch]), all(hi[1][patch])},
          Interval{all(lo[2][patch]), all(hi[2][patch])}};
}
/// Returns the boxes of the patches from `patch` on, one in each lane.
HWY_INLINE Box boxes_from(const Coordinates& lo, const Coordinates& hi, Index patch) {
  return {Interval{load(&lo[0][patch]), load(&hi[0][patch])}, Interval{load(&lo[1][patch]), load(&hi[1][patch])},
          Interval{load(&lo[2][patch]), load(&hi[2][patch])}};
}

/// The positions of a patch, in registers.
struct Positions {
  static constexpr std::size_t blocks = max_lanes / lanes;
  V x[blocks], y[blocks], z[blocks];

  HWY_INLINE Positions(const std::vector<float>& px, const std::vector<float>& py, const std::vector<float>& pz,
                       Index first) {
    for (std::size_t k = 0; k < blocks; ++k) {
      x[k] = load(&px[first + k * lanes]);
      y[k] = load(&py[first + k * lanes]);
      z[k] = load(&pz[first + k * lanes]);
    }
  }
  HWY_INLINE Box box(std::size_t k) const { return {Interval{x[k], x[k]}, Interval{y[k], y[k]}, Interval{z[k], z[k]}}; }
  HWY_INLINE M close(std::size_t k, V px, V py, V pz, V limit) const {
    return hn::Lt(squared_length(hn::Sub(px, x[k]), hn::Sub(py, y[k]), hn::Sub(pz, z[k])), limit);
  }
};

HWY_INLINE std::uint64_t first_bits(Index count) { return (std::uint64_t{1} << count) - 1; }

/// Clears the bits of the slots from `first` on that mesh edges join to slot i.
HWY_INLINE std::uint64_t without_joined(const Patches& patches, Index i, Index first, std::uint64_t bits) {
  for (Index k = patches.first_joined[i]; k < patches.first_joined[i + std::size_t{1}]; ++k) {
    const Index other = patches.joined[k] - first;
    bits &= ~(std::uint64_t{other < max_lanes} << other % max_lanes);
  }
  return bits;
}

template <bool within>
HWY_INLINE Contact* contacts_of_pair(const Patches& patches, Index one, const Positions& at_a, const Positions& rest_a,
                                     Index other, V limit, Contact* end) {
  const Points& now = *patches.now;
  const Range a = patches.slots(one), b = patches.slots(other);
  const Box box = box_of(patches.lo, patches.hi, other);
  std::uint64_t rows = 0;  // of the vertices of a that may have contacts with any in the box of b
  for (std::size_t k = 0; k < Positions::blocks; ++k) {
    M near = is_near(at_a.box(k), box, limit);
    if constexpr (within) {
      near = hn::AndNot(is_excluded(rest_a.box(k), box_of(patches.rest_lo, patches.rest_hi, other), limit), near);
    }
    rows |= bits_of(Floats(), near) << k * lanes;
  }
  const Positions at(now.x, now.y, now.z, b.begin);
  const Positions rest = within ? Positions(patches.rest_x, patches.rest_y, patches.rest_z, b.begin) : at;
  const Index* const vertex = &now.vertex[b.begin];
  for (rows &= first_bits(a.size()); rows != 0; rows &= rows - 1) {
    const auto row = static_cast<Index>(std::countr_zero(rows));
    const Index i = a.begin + row;
    const V x = all(now.x[i]), y = all(now.y[i]), z = all(now.z[i]);
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < Positions::blocks; ++k) {
      M close = at.close(k, x, y, z, limit);
      if constexpr (within) {
        const V rx = all(patches.rest_x[i]), ry = all(patches.rest_y[i]), rz = all(patches.rest_z[i]);
        close = hn::AndNot(rest.close(k, rx, ry, rz, limit), close);
      }
      bits |= bits_of(Floats(), close) << k * lanes;
    }
    bits &= first_bits(b.size());
    if (within && one == other) bits &= ~std::uint64_t{1} << row;
    if (bits == 0) continue;
    if (within) bits = without_joined(patches, i, b.begin, bits);
    const Index first = now.vertex[i];
    for (; bits != 0; bits &= bits - 1) {
      const Index second = vertex[std::countr_zero(bits)];
      *end++ = {std::min(first, second), std::max(first, second)};
    }
  }
  return end;
}

template <bool within>
HWY_INLINE PatchContacts patch_contacts(const Patches& patches, Index patch, Range others, float tolerance2,
                                        Contact* contacts) {
  const V limit = all(tolerance2);
  const Points& now = *patches.now;
  const Range a = patches.slots(patch);
  const Positions at(now.x, now.y, now.z, a.begin);
  const Positions rest = within ? Positions(patches.rest_x, patches.rest_y, patches.rest_z, a.begin) : at;
  const Box box = box_of(patches.lo, patches.hi, patch);
  PatchContacts found;
  Contact* end = contacts;
  for (Index first = others.begin; first < others.end; first += lanes) {
    M near = is_near(box, boxes_from(patches.lo, patches.hi, first), limit);
    if constexpr (within) {
      const Box rest_box = box_of(patches.rest_lo, patches.rest_hi, patch);
      near = hn::AndNot(is_excluded(rest_box, boxes_from(patches.rest_lo, patches.rest_hi, first), limit), near);
    }
    std::uint64_t bits = bits_of(Floats(), near) & first_bits(std::min(lanes, others.end - first));
    for (; bits != 0; bits &= bits - 1) {
      const Index other = first + static_cast<Index>(std::countr_zero(bits));
      end = contacts_of_pair<within>(patches, patch, at, rest, other, limit, end);
      const std::uint64_t size = a.size();
      found.pair_tests += other == patch ? size * (size - 1) / 2 : size * patches.slots(other).size();
    }
  }
  found.contacts = static_cast<Index>(end - contacts);
  return found;
}

PatchContacts FindPatchContacts(const Patches& patches, bool within, Index patch, Range others, float tolerance2,
                                Contact* contacts) {
  return within ? patch_contacts<true>(patches, patch, others, tolerance2, contacts)
                : patch_contacts<false>(patches, patch, others, tolerance2, contacts);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

HWY_EXPORT(FindPatchContacts);

PatchContacts find_patch_contacts(const Patches& patches, bool within, Index patch, Range others, float tolerance2,
                                  Contact* contacts) {
  return HWY_DYNAMIC_DISPATCH(FindPatchContacts)(patches, within, patch, others, tolerance2, contacts);
}

}  // namespace collide::exact
#endif  // HWY_ONCE
