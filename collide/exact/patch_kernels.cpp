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

template <bool within>
HWY_INLINE Index patch_contacts(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts) {
  const Points& now = *points.now;
  const V limit = all(tolerance2);
  const Patch at(&now.x[b.begin], &now.y[b.begin], &now.z[b.begin]);
  const Patch rest = within ? Patch(&points.rest_x[b.begin], &points.rest_y[b.begin], &points.rest_z[b.begin]) : at;
  const std::uint64_t inside = (std::uint64_t{1} << b.size()) - 1;
  const Index* const vertex = &now.vertex[b.begin];
  Contact* end = contacts;
  for (Index i = a.begin; i < a.end; ++i) {
    const V x = all(now.x[i]), y = all(now.y[i]), z = all(now.z[i]);
    std::uint64_t bits = 0;
    if constexpr (within) {
      const V rx = all(points.rest_x[i]), ry = all(points.rest_y[i]), rz = all(points.rest_z[i]);
      for (std::size_t k = 0; k < Patch::blocks; ++k) {
        const M close = hn::AndNot(rest.close(k, rx, ry, rz, limit), at.close(k, x, y, z, limit));
        bits |= bits_of(Floats(), close) << k * lanes;
      }
      if (a.begin == b.begin) bits &= ~std::uint64_t{1} << (i - b.begin);
    } else {
      for (std::size_t k = 0; k < Patch::blocks; ++k) {
        bits |= bits_of(Floats(), at.close(k, x, y, z, limit)) << k * lanes;
      }
    }
    bits &= inside;
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

Index PatchContactsWithin(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts) {
  return patch_contacts<true>(points, a, b, tolerance2, contacts);
}
Index PatchContactsBetween(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts) {
  return patch_contacts<false>(points, a, b, tolerance2, contacts);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

HWY_EXPORT(PatchContactsWithin);
HWY_EXPORT(PatchContactsBetween);

Index patch_contacts_within(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts) {
  return HWY_DYNAMIC_DISPATCH(PatchContactsWithin)(points, a, b, tolerance2, contacts);
}

Index patch_contacts_between(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts) {
  return HWY_DYNAMIC_DISPATCH(PatchContactsBetween)(points, a, b, tolerance2, contacts);
}

}  // namespace collide::exact
#endif  // HWY_ONCE
