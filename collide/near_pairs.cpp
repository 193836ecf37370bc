#include "collide/near_pairs.h"

#include <algorithm>

namespace collide {

namespace {

constexpr Index block = Points::padding;

/// One vertex against a run. Candidates come in blocks that the compiler vectorises; contacts are rare, so a block
/// first answers "any hit at all?". The last block may run past b.end, into slots that the second look leaves out.
[[gnu::always_inline]] inline void search_row(const Points& points, Index i, Range b, float tolerance2,
                                              std::vector<SlotPair>& hits) {
  const float px = points.x[i], py = points.y[i], pz = points.z[i];
  for (Index j = std::max(b.begin, i + 1); j < b.end; j += block) {
    const float *bx = &points.x[j], *by = &points.y[j], *bz = &points.z[j];
    std::uint32_t any = 0;
#pragma GCC unroll 1  // g++ would unroll these turns before it tries to vectorise them, and then cannot
    for (Index k = 0; k < block; ++k) {
      any |= squared_distance(px, py, pz, bx[k], by[k], bz[k]) < tolerance2 ? 1u : 0u;
    }
    if (any == 0) continue;
    for (Index k = 0; k < std::min(block, b.end - j); ++k) {
      if (squared_distance(px, py, pz, bx[k], by[k], bz[k]) < tolerance2) hits.push_back({i, j + k});
    }
  }
}

[[gnu::always_inline]] inline void search_all(const Points& points, Range a, Range b, float tolerance2,
                                              std::vector<SlotPair>& hits) {
  for (Index i = a.begin; i < a.end; ++i) search_row(points, i, b, tolerance2, hits);
}

[[gnu::always_inline]] inline Index search_near(const Points& points, Range a, Range b, const Aabb& region, float reach,
                                                float tolerance2, std::vector<SlotPair>& hits) {
  const auto [lo, hi] = region;
  Index rows = 0;
  for (Index first = a.begin; first < a.end; first += block) {
    const float *x = &points.x[first], *y = &points.y[first], *z = &points.z[first];
    std::array<std::uint32_t, block> near;
#pragma GCC unroll 1
    for (Index k = 0; k < block; ++k) {  // as near() of aabb.h, without branches
      near[k] = (x[k] - hi.x <= reach) & (lo.x - x[k] <= reach) & (y[k] - hi.y <= reach) & (lo.y - y[k] <= reach) &
                (z[k] - hi.z <= reach) & (lo.z - z[k] <= reach);
    }
    for (Index k = 0; k < std::min(block, a.end - first); ++k) {
      if (near[k] == 0) continue;
      search_row(points, first + k, b, tolerance2, hits);
      ++rows;
    }
  }
  return rows;
}

struct Searches {
  void (*all)(const Points&, Range, Range, float, std::vector<SlotPair>&);
  Index (*near)(const Points&, Range, Range, const Aabb&, float, float, std::vector<SlotPair>&);
};

void all_baseline(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits) {
  search_all(points, a, b, tolerance2, hits);
}

Index near_baseline(const Points& points, Range a, Range b, const Aabb& region, float reach, float tolerance2,
                    std::vector<SlotPair>& hits) {
  return search_near(points, a, b, region, reach, tolerance2, hits);
}

// Not target_clones: its resolvers run before the sanitizers are set up. Without fma, so that results stay equal.
#if defined(__x86_64__)
__attribute__((target("avx2"))) void all_avx2(const Points& points, Range a, Range b, float tolerance2,
                                              std::vector<SlotPair>& hits) {
  search_all(points, a, b, tolerance2, hits);
}

__attribute__((target("avx2"))) Index near_avx2(const Points& points, Range a, Range b, const Aabb& region, float reach,
                                                float tolerance2, std::vector<SlotPair>& hits) {
  return search_near(points, a, b, region, reach, tolerance2, hits);
}

Searches pick() {
  return __builtin_cpu_supports("avx2") ? Searches{all_avx2, near_avx2} : Searches{all_baseline, near_baseline};
}
#else
Searches pick() { return {all_baseline, near_baseline}; }
#endif

const Searches& best() {
  static const Searches picked = pick();
  return picked;
}

}  // namespace

void near_pairs(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits) {
  best().all(points, a, b, tolerance2, hits);
}

Index near_pairs(const Points& points, Range a, Range b, const Aabb& region, float reach, float tolerance2,
                 std::vector<SlotPair>& hits) {
  return best().near(points, a, b, region, reach, tolerance2, hits);
}

}  // namespace collide
