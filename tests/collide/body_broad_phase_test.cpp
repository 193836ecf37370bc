// The broad phase of bodies against all pairs, on every target.

#include "collide/exact/body_broad_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "collide/core/cutoff.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

BodyBounds bound_around(const glm::vec3& lo, const glm::vec3& hi, float radius) {
  BodyBounds bound{{lo, hi}, lo * 0.5f + hi * 0.5f, radius, 0, true};
  return bound;
}

/// Boxes of sides up to `side` in a box of the given size; the spheres around them reach less far than their corners.
std::vector<BodyBounds> boxes(std::mt19937& random, Index count, const glm::vec3& space, float side) {
  std::vector<BodyBounds> bounds;
  for (Index i = 0; i < count; ++i) {
    const glm::vec3 lo = random_points(random, 1, 0, 1)[0] * space, size = random_points(random, 1, 0, side)[0];
    bounds.push_back(bound_around(lo, lo + size, 0.4f * std::max({size.x, size.y, size.z})));
  }
  return bounds;
}

struct Expected {
  std::vector<std::vector<Index>> neighbours;
  std::uint64_t near_box_pairs = 0, pairs = 0, alone = 0;

  Expected(const std::vector<BodyBounds>& bounds, const std::vector<Index>& live, float reach)
      : neighbours(bounds.size()) {
    std::set<Index> paired;
    for (const Index a : live) {
      for (const Index b : live) {
        if (a >= b || !near(bounds[a].box, bounds[b].box, reach)) continue;
        ++near_box_pairs;
        const glm::dvec3 d = glm::dvec3(bounds[b].centre) - glm::dvec3(bounds[a].centre);
        const double reached = double{bounds[a].radius} + bounds[b].radius + reach;
        if (d.x * d.x + d.y * d.y + d.z * d.z > reached * reached * 1.000004) continue;  // with the kernel's margin
        neighbours[a].push_back(b);
        paired.insert({a, b});
        ++pairs;
      }
    }
    alone = live.size() - paired.size();
  }
};

void check(const std::vector<BodyBounds>& bounds, const std::vector<Index>& live, float reach, const char* what) {
  const Expected expected(bounds, live, reach);
  for (const std::int64_t target : targets()) {
    const tests::UseTarget use(target);
    for (const int threads : {1, 2, 3}) {
      Workers workers(threads, 0);
      BodyBroadPhase near;
      near.find(bounds, live, reach, workers);
      EXPECT_EQ(near.pairs(), expected.pairs) << what;
      EXPECT_EQ(near.near_box_pairs(), expected.near_box_pairs) << what;
      EXPECT_EQ(near.isolated_bodies(), expected.alone) << what;
      std::uint64_t before = 0;
      for (Index body = 0; body < bounds.size(); ++body) {
        const auto neighbours = near.later_neighbours(body);
        ASSERT_EQ(std::vector<Index>(neighbours.begin(), neighbours.end()), expected.neighbours[body])
            << what << ' ' << body;
        EXPECT_EQ(near.pairs_before(body), before);
        before += neighbours.size();
      }
    }
  }
}

std::vector<Index> all_of(const std::vector<BodyBounds>& bounds) {
  std::vector<Index> live(bounds.size());
  std::iota(live.begin(), live.end(), Index{0});
  return live;
}

TEST(BodyBroadPhase, FindsThePairsOfAPlainLoop) {
  std::mt19937 random(51);
  for (const Index count : {0u, 1u, 2u, 3u, 17u, 300u}) {
    for (const glm::vec3& space :
         {glm::vec3(6), glm::vec3(40, 3, 1), glm::vec3(0, 30, 0), glm::vec3(0, 9, 9), glm::vec3(0)}) {
      for (const float side : {0.0f, 0.3f, 1.5f}) {
        const std::vector<BodyBounds> bounds = boxes(random, count, space, side);
        check(bounds, all_of(bounds), 0.1f, "random");
      }
    }
  }
}

TEST(BodyBroadPhase, FindsPairsOfHugeLongAndThinBoxesAndOfLiveBodiesOnly) {
  std::mt19937 random(52);
  std::vector<BodyBounds> bounds = boxes(random, 200, glm::vec3(30), 0.8f);
  bounds[77] = bound_around(glm::vec3(-5), glm::vec3(20), 25);
  check(bounds, all_of(bounds), 0.2f, "huge");
  std::vector<Index> live;
  for (Index i = 0; i < bounds.size(); ++i) {
    if (i % 3 != 0) live.push_back(i);
  }
  check(bounds, live, 0.2f, "live");
  for (BodyBounds& bound : bounds) {  // some begin far before those that they meet
    const glm::vec3 lo = random_points(random, 1, 0, 1)[0] * glm::vec3(40, 10, 1);
    bound = bound_around(lo, lo + random_points(random, 1, 0.1f, 1)[0] * glm::vec3(6, 0.2f, 0.2f), 4);
  }
  check(bounds, all_of(bounds), 0.1f, "long");
}

TEST(BodyBroadPhase, LosesNoSpheresThatJustTouchToRounding) {
  std::mt19937 random(55);
  constexpr float reach = 0.2f;
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<glm::vec3> at = random_points(random, 2, -3, 3);
    std::vector<BodyBounds> bounds;
    for (const glm::vec3& centre : at) bounds.push_back(bound_around(centre - 3.0f, centre + 3.0f, 0));
    const glm::dvec3 d = glm::dvec3(bounds[1].centre) - glm::dvec3(bounds[0].centre);
    const double apart = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    if (apart < 1) continue;
    for (BodyBounds& bound : bounds) bound.radius = round_up((apart - double{reach}) / 2);
    check(bounds, all_of(bounds), reach, "touching");
  }
}

TEST(BodyBroadPhase, FindsPairsOfAnySize) {
  std::mt19937 random(53);
  for (const float scale : {1e-40f, 1e-20f, 1e10f, 1e17f}) {
    std::vector<BodyBounds> bounds = boxes(random, 120, glm::vec3(8), 1);
    for (BodyBounds& bound : bounds) {
      bound = bound_around(bound.box.lo * scale, bound.box.hi * scale, std::numeric_limits<float>::infinity());
    }
    check(bounds, all_of(bounds), 0.1f * scale, "scaled");
  }
}

TEST(BodyBroadPhase, ThrowsBeyondItsLimitAndCanBeUsedAgain) {
  const std::vector<BodyBounds> crowd(20, bound_around(glm::vec3(0), glm::vec3(1), 1));
  for (const int threads : {1, 3}) {
    Workers workers(threads, 0);
    BodyBroadPhase near;
    near.find(crowd, all_of(crowd), 0.1f, workers, 190);
    EXPECT_EQ(near.pairs(), 190u);
    EXPECT_THROW(near.find(crowd, all_of(crowd), 0.1f, workers, 189), std::length_error);
    for (Index body = 0; body < crowd.size(); ++body) EXPECT_TRUE(near.later_neighbours(body).empty());
    near.find(crowd, all_of(crowd), 0.1f, workers);
    EXPECT_EQ(near.later_neighbours(0).size(), 19u);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
