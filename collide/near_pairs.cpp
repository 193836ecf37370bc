#include "collide/near_pairs.h"

#include <algorithm>

namespace collide {

namespace {

constexpr Index block = Places::padding;

/// One vertex against a run. Candidates come in blocks that the compiler vectorises; contacts are rare, so a block
/// first answers "any hit at all?". The last block may run past b.end, into slots that the second look leaves out.
[[gnu::always_inline]] inline void search_row(const Places& places, Index i, Range b, float tolerance2,
                                              std::vector<SlotPair>& hits) {
  const float px = places.x[i], py = places.y[i], pz = places.z[i];
  for (Index j = std::max(b.begin, i + 1); j < b.end; j += block) {
    const float *bx = &places.x[j], *by = &places.y[j], *bz = &places.z[j];
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

[[gnu::always_inline]] inline void search_all(const Places& places, Range a, Range b, float tolerance2,
                                              std::vector<SlotPair>& hits) {
  for (Index i = a.begin; i < a.end; ++i) search_row(places, i, b, tolerance2, hits);
}

using Search = void (*)(const Places&, Range, Range, float, std::vector<SlotPair>&);

void all_baseline(const Places& places, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits) {
  search_all(places, a, b, tolerance2, hits);
}

// Not target_clones: its resolvers run before the sanitizers are set up. Without fma, so that results stay equal.
#if defined(__x86_64__)
__attribute__((target("avx2"))) void all_avx2(const Places& places, Range a, Range b, float tolerance2,
                                              std::vector<SlotPair>& hits) {
  search_all(places, a, b, tolerance2, hits);
}

Search pick() { return __builtin_cpu_supports("avx2") ? all_avx2 : all_baseline; }
#else
Search pick() { return all_baseline; }
#endif

}  // namespace

void near_pairs(const Places& places, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits) {
  static const Search best = pick();
  best(places, a, b, tolerance2, hits);
}

}  // namespace collide
