// The loops over runs of slots against plain ones, on every target.

#include "collide/core/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/common.hpp>

#include "collide/core/cutoff.h"

#include "every_target.h"

namespace collide::test {
namespace THIS_FILE {

using NearPairs = OnEveryTarget;

std::vector<std::tuple<Index, Index>> sorted(const std::vector<SlotPair>& hits) {
  std::vector<std::tuple<Index, Index>> pairs;
  for (const SlotPair& hit : hits) pairs.emplace_back(hit.a, hit.b);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST_P(NearPairs, AreThoseOfPlainLoops) {
  constexpr float tolerance2 = 0.1f;
  Points points;
  points.resize(120);
  for (Index slot = 0; slot < points.size(); ++slot) {
    const glm::vec3 p = random_points(random_, 1, 0, 1)[0];
    points.x[slot] = p.x, points.y[slot] = p.y, points.z[slot] = p.z;
  }
  const auto place = [&](Index slot) { return glm::vec3(points.x[slot], points.y[slot], points.z[slot]); };
  Index left_out = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto begin = static_cast<Index>(random_() % 40), end = static_cast<Index>(begin + 1 + random_() % 20);
    const Range a{begin, end};
    std::vector<Range> runs;
    for (Index next = end; next < points.size();) {
      const Range run{next, std::min(points.size(), static_cast<Index>(next + 1 + random_() % 12))};
      runs.push_back(run);
      next = static_cast<Index>(run.end + random_() % 9);
    }
    std::vector<SlotPair> in_runs, within, hits;
    const auto plain = [&](Range b, std::vector<SlotPair>& into) {
      for (Index i = a.begin; i < a.end; ++i) {
        for (Index j = std::max(b.begin, i + 1); j < b.end; ++j) {
          if (squared_distance(points.x[i], points.y[i], points.z[i], points.x[j], points.y[j], points.z[j]) <
              tolerance2) {
            into.push_back({i, j});
          }
        }
      }
    };
    for (const Range run : runs) plain(run, in_runs);
    near_pairs(points, a, runs, tolerance2, hits);
    EXPECT_EQ(sorted(hits), sorted(in_runs));
    hits.clear();
    plain({begin, 120}, within);
    near_pairs(points, a, {begin, 120}, tolerance2, hits);
    EXPECT_EQ(sorted(hits), sorted(within));
    EXPECT_FALSE(within.empty());

    const Range b = runs.front();
    Aabb box{glm::vec3(1), glm::vec3(0)};
    for (Index slot = b.begin; slot < b.end; ++slot) {
      box.lo = glm::min(box.lo, place(slot));
      box.hi = glm::max(box.hi, place(slot));
    }
    hits.clear();
    in_runs.clear();
    plain(b, in_runs);
    const float cutoff = contact_cutoff(std::sqrt(tolerance2));
    const Index tested = near_pairs(points, a, b, box, cutoff, tolerance2, hits);
    EXPECT_EQ(sorted(hits), sorted(in_runs));
    Index near_box = 0;
    for (Index slot = a.begin; slot < a.end; ++slot) near_box += near({place(slot), place(slot)}, box, cutoff);
    EXPECT_EQ(tested, near_box);
    left_out += a.size() - near_box;
  }
  EXPECT_GT(left_out, 100u);
}

INSTANTIATE_TEST_SUITE_P(Targets, NearPairs, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
