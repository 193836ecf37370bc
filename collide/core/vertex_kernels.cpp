#include "collide/core/vertex_kernels.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/core/vertex_kernels.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide {
namespace HWY_NAMESPACE {
namespace {

bool all_finite(const VertexRun& run) {
  for (Index v = 0; v < run.size; ++v) {
    if (!std::isfinite(run.x[v]) || !std::isfinite(run.y[v]) || !std::isfinite(run.z[v])) return false;
  }
  return true;
}

BodyBounds BoundOf(const VertexRun& run) {
  Copy copy;
  const VertexRun at = readable(run, copy);
  V lx = all(run.x[0]), ly = all(run.y[0]), lz = all(run.z[0]), hx = lx, hy = ly, hz = lz;
  for_blocks(run.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V x = load(at.x + i), y = load(at.y + i), z = load(at.z + i);
    lx = hn::Min(lx, x), ly = hn::Min(ly, y), lz = hn::Min(lz, z);
    hx = hn::Max(hx, x), hy = hn::Max(hy, y), hz = hn::Max(hz, z);
  });
  BodyBounds bound;
  bound.box = {{least(lx), least(ly), least(lz)}, {most(hx), most(hy), most(hz)}};
  bound.centre = bound.box.lo * 0.5f + bound.box.hi * 0.5f;
  bound.largest =
      std::max({-bound.box.lo.x, -bound.box.lo.y, -bound.box.lo.z, bound.box.hi.x, bound.box.hi.y, bound.box.hi.z});

  const V cx = all(bound.centre.x), cy = all(bound.centre.y), cz = all(bound.centre.z);
  V farthest = hn::Zero(Floats()), total = farthest;
  for_blocks(run.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V d2 = squared_length(hn::Sub(load(at.x + i), cx), hn::Sub(load(at.y + i), cy), hn::Sub(load(at.z + i), cz));
    farthest = hn::Max(farthest, d2);
    total = hn::Add(total, d2);
  });
  bound.radius = root_above(most(farthest));
  // NaN and infinity show in the sum; so does overflow.
  bound.finite = std::isfinite(sum(total)) || all_finite(run);
  if (!std::isfinite(sum(total))) bound.radius = std::numeric_limits<float>::infinity();
  return bound;
}

AffineFit FitAffine(const VertexRun& body, const VertexRun& reference, const std::array<float, 9>& inverse_moment,
                    const glm::vec3& centre, float* residual2) {
  const V cx = all(centre.x), cy = all(centre.y), cz = all(centre.z), zero = hn::Zero(Floats());
  V xx = zero, xy = zero, xz = zero, yx = zero, yy = zero, yz = zero, zx = zero, zy = zero, zz = zero;
  V mx = zero, my = zero, mz = zero;
  const auto add_block = [&](Index i) HWY_ATTR {
    const V bx = hn::Sub(load(body.x + i), cx), by = hn::Sub(load(body.y + i), cy), bz = hn::Sub(load(body.z + i), cz);
    const V rx = load(reference.x + i), ry = load(reference.y + i), rz = load(reference.z + i);
    xx = hn::Add(xx, hn::Mul(bx, rx)), xy = hn::Add(xy, hn::Mul(bx, ry)), xz = hn::Add(xz, hn::Mul(bx, rz));
    yx = hn::Add(yx, hn::Mul(by, rx)), yy = hn::Add(yy, hn::Mul(by, ry)), yz = hn::Add(yz, hn::Mul(by, rz));
    zx = hn::Add(zx, hn::Mul(bz, rx)), zy = hn::Add(zy, hn::Mul(bz, ry)), zz = hn::Add(zz, hn::Mul(bz, rz));
    mx = hn::Add(mx, bx), my = hn::Add(my, by), mz = hn::Add(mz, bz);
  };
  Index sampled = 0;
  for (Index first = 0; first + sample_run <= body.size; first += sample_stride(body.size)) {
    for (Index i = first; i < first + sample_run; i += lanes) add_block(i);
    sampled += sample_run;
  }

  AffineFit fit;
  const std::array<float, 9> moment{sum(xx), sum(xy), sum(xz), sum(yx), sum(yy), sum(yz), sum(zx), sum(zy), sum(zz)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      fit.matrix[3 * row + column] = moment[3 * row] * inverse_moment[column] +
                                     moment[3 * row + 1] * inverse_moment[3 + column] +
                                     moment[3 * row + 2] * inverse_moment[6 + column];
    }
  }
  const float share = 1.0f / static_cast<float>(sampled);
  fit.offset = {sum(mx) * share, sum(my) * share, sum(mz) * share};

  V farthest = zero;
  const auto error = [&](std::size_t row, V b, V c, V rx, V ry, V rz) HWY_ATTR {
    const float* m = &fit.matrix[3 * row];
    const V mapped = hn::Add(hn::Add(hn::Mul(all(m[0]), rx), hn::Mul(all(m[1]), ry)), hn::Mul(all(m[2]), rz));
    return hn::Sub(hn::Sub(hn::Sub(b, c), all(fit.offset[row])), mapped);
  };
  for_blocks(body.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V rx = load(reference.x + i), ry = load(reference.y + i), rz = load(reference.z + i);
    const V e2 = squared_length(error(0, load(body.x + i), cx, rx, ry, rz), error(1, load(body.y + i), cy, rx, ry, rz),
                                error(2, load(body.z + i), cz, rx, ry, rz));
    farthest = hn::Max(farthest, e2);
    hn::StoreU(e2, Floats(), residual2 + i);
  });
  fit.residual = std::sqrt(most(farthest));
  return fit;
}

Index ListAbove(const float* values, Index size, float limit, Index* list) {
  ListWriter above(list);
  for_blocks(size, [&](std::ptrdiff_t i, Index skip)
                       HWY_ATTR { above.add(hn::Not(hn::Le(load(values + i), all(limit))), i, skip); });
  return above.size();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide {

HWY_EXPORT(BoundOf);
HWY_EXPORT(FitAffine);
HWY_EXPORT(ListAbove);

BodyBounds measure_bounds(const VertexRun& run) { return HWY_DYNAMIC_DISPATCH(BoundOf)(run); }

AffineFit fit_affine(const VertexRun& body, const VertexRun& reference, const std::array<float, 9>& inverse_moment,
                     const glm::vec3& centre, std::span<float> residual2) {
  assert(body.size == reference.size && body.size >= sample_run && residual2.size() >= body.size);
  return HWY_DYNAMIC_DISPATCH(FitAffine)(body, reference, inverse_moment, centre, residual2.data());
}

Index list_above(std::span<const float> values, float limit, Index* list) {
  assert(values.size() >= max_lanes);
  return HWY_DYNAMIC_DISPATCH(ListAbove)(values.data(), static_cast<Index>(values.size()), limit, list);
}

}  // namespace collide
#endif  // HWY_ONCE
