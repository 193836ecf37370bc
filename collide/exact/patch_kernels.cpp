#include "collide/exact/patch_kernels.h"

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

/// The positions of up to max_lanes vertices, in registers.
struct Patch {
  static constexpr std::size_t blocks = max_lanes / lanes;
  V x[blocks], y[blocks], z[blocks];

  HWY_INLINE Patch(const float* px, const float* py, const float* pz) {
    for (std::size_t k = 0; k < blocks; ++k) {
      x[k] = load(px + k * lanes);
      y[k] = load(py + k * lanes);
      z[k] = load(pz + k * lanes);
    }
  }
  HWY_INLINE M close(std::size_t k, V px, V py, V pz, V limit) const {
    return hn::Lt(squared_length(hn::Sub(px, x[k]), hn::Sub(py, y[k]), hn::Sub(pz, z[k])), limit);
  }
};

/// Clears the bits of the slots of b that mesh edges join to slot i.
HWY_INLINE std::uint64_t without_joined(const PatchPoints& points, Index i, Range b, std::uint64_t bits) {
  for (Index k = points.first_joined[i]; k < points.first_joined[i + std::size_t{1}]; ++k) {
    const Index other = points.joined[k] - b.begin;
    bits &= ~(std::uint64_t{other < max_lanes} << other % max_lanes);
  }
  return bits;
}

/// Returns a bit for each vertex of a patch that may have contacts with vertices in a box, by the bounds of
/// least_squared_distance() and greatest_squared_rest_distance().
HWY_INLINE std::uint64_t near_rows(const Patch& at, const Patch* rest, const PatchBoxes& box, V limit) {
  const V zero = hn::Zero(Floats());
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < Patch::blocks; ++k) {
    const auto gap = [&](V p, std::size_t axis) HWY_ATTR {
      return hn::Max(hn::Max(hn::Sub(p, all(box.hi[axis])), hn::Sub(all(box.lo[axis]), p)), zero);
    };
    M near = hn::Lt(squared_length(gap(at.x[k], 0), gap(at.y[k], 1), gap(at.z[k], 2)), limit);
    if (rest) {
      const auto side = [&](V p, std::size_t axis) HWY_ATTR {
        return hn::Max(hn::Sub(p, all(box.rest_lo[axis])), hn::Sub(all(box.rest_hi[axis]), p));
      };
      near = hn::AndNot(hn::Lt(squared_length(side(rest->x[k], 0), side(rest->y[k], 1), side(rest->z[k], 2)), limit),
                        near);
    }
    bits |= bits_of(Floats(), near) << k * lanes;
  }
  return bits;
}

HWY_INLINE std::uint64_t first_bits(Index count) { return (std::uint64_t{1} << count) - 1; }

template <bool within>
HWY_INLINE Index patch_contacts(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b,
                                float tolerance2, Contact* contacts) {
  const Points& now = *points.now;
  const V limit = all(tolerance2);
  const auto now_at = [&](Range r) HWY_ATTR { return Patch(&now.x[r.begin], &now.y[r.begin], &now.z[r.begin]); };
  const auto rest_at = [&](Range r) HWY_ATTR {
    return Patch(&points.rest_x[r.begin], &points.rest_y[r.begin], &points.rest_z[r.begin]);
  };
  std::uint64_t rows = first_bits(a.size());
  if constexpr (within) {
    const Patch rest = rest_at(a);
    rows &= near_rows(now_at(a), &rest, box_of_b, limit);
  } else {
    rows &= near_rows(now_at(a), nullptr, box_of_b, limit);
  }
  const Patch at = now_at(b), rest = within ? rest_at(b) : at;
  const std::uint64_t columns = first_bits(b.size());
  const Index* const vertex = &now.vertex[b.begin];
  Contact* end = contacts;
  for (; rows != 0; rows &= rows - 1) {
    const auto row = static_cast<Index>(std::countr_zero(rows));
    const Index i = a.begin + row;
    const V x = all(now.x[i]), y = all(now.y[i]), z = all(now.z[i]);
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < Patch::blocks; ++k) {
      M close = at.close(k, x, y, z, limit);
      if constexpr (within) {
        const V rx = all(points.rest_x[i]), ry = all(points.rest_y[i]), rz = all(points.rest_z[i]);
        close = hn::AndNot(rest.close(k, rx, ry, rz, limit), close);
      }
      bits |= bits_of(Floats(), close) << k * lanes;
    }
    bits &= columns;
    if (within && a.begin == b.begin) bits &= ~std::uint64_t{1} << row;
    if (bits == 0) continue;
    if (within) bits = without_joined(points, i, b, bits);
    const Index first = now.vertex[i];
    for (; bits != 0; bits &= bits - 1) {
      const Index second = vertex[std::countr_zero(bits)];
      *end++ = {std::min(first, second), std::max(first, second)};
    }
  }
  return static_cast<Index>(end - contacts);
}

Index PatchContactsWithin(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b, float tolerance2,
                          Contact* contacts) {
  return patch_contacts<true>(points, a, b, box_of_b, tolerance2, contacts);
}
Index PatchContactsBetween(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b, float tolerance2,
                           Contact* contacts) {
  return patch_contacts<false>(points, a, b, box_of_b, tolerance2, contacts);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

HWY_EXPORT(PatchContactsWithin);
HWY_EXPORT(PatchContactsBetween);

Index patch_contacts_within(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b, float tolerance2,
                            Contact* contacts) {
  return HWY_DYNAMIC_DISPATCH(PatchContactsWithin)(points, a, b, box_of_b, tolerance2, contacts);
}

Index patch_contacts_between(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b, float tolerance2,
                             Contact* contacts) {
  return HWY_DYNAMIC_DISPATCH(PatchContactsBetween)(points, a, b, box_of_b, tolerance2, contacts);
}

}  // namespace collide::exact
#endif  // HWY_ONCE
