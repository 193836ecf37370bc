// The candidates of surface contact: their order, their number, their limits, and how long they are valid.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <stdexcept>

#include "every_target.h"
#include "moving_surfaces.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

/// Returns all candidates as numbers that can be compared.
std::vector<std::array<float, 8>> listed(const SurfaceSearch& search) {
  std::vector<std::array<float, 8>> list;
  for (const SurfacePair& p : search.pairs())
    for (std::uint32_t i = p.vertex_face; i < p.end; ++i) {
      const FeaturePair& f = search.features()[i];
      list.push_back({float(p.a), float(p.b), float(p.vertex_face), float(p.face_vertex), float(p.edge_edge),
                      float(f.a), float(f.b), f.earliest});
    }
  return list;
}

TEST(SurfaceSearch, ThrowsAboveMaxFeatures) {
  std::mt19937 random(72);
  const MovingScene m = swarm(random, 5, 0.02f, 0.01f);
  SearchRun run(m, true);
  const std::size_t all = run.search.features().size();
  const auto find = [&](std::size_t max) {
    Workers workers(2, 0);
    run.search.find({m.scene.frame(), run.vx, run.vy, run.vz}, m.traits, {m.seconds, m.seconds, true, max}, workers);
    return run.search.features().size();
  };
  EXPECT_THROW(find(all - 1), std::length_error);
  EXPECT_THROW(find(all / 4), std::length_error);
  EXPECT_EQ(find(all), all);
}

TEST(SurfaceSearch, ListsAPairWithoutCandidatesIfOneBodyIsInsideTheOther) {
  for (const auto& [first, second] : {std::pair(0.5f, 0.1f), std::pair(0.1f, 0.5f)}) {
    MovingScene m;
    for (const float radius : {first, second}) m.add(ball(radius), glm::vec3(0), 0.01f, 0.01f, still);
    const SearchRun run(m, false);
    EXPECT_TRUE(run.search.features().empty());
    ASSERT_EQ(run.search.pairs().size(), 1u) << first;
    EXPECT_EQ(run.search.pairs()[0].bodies(), (std::pair<Index, Index>(0, 1)));
  }
}

TEST(SurfaceSearch, WorkCountsBoxesOverlapsAndCandidates) {
  const SurfaceMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto two = [&](float apart, bool move = true) {
    MovingScene m;
    for (const float z : {0.0f, apart}) m.add(triangle, {0, 0, z}, 2, 0.1f, still);
    for (SurfaceBody& body : m.traits) body.moves = move;
    return SearchRun(m, false);
  };
  // 14 features. 6 pairs of a vertex and a face and 9 pairs of edges have overlapping boxes; all are candidates.
  EXPECT_EQ(two(0.5f).search.features().size(), 15u);
  EXPECT_EQ(two(0.5f).search.work(), 14u + 15u + 15u);
  EXPECT_EQ(two(4.5f).search.work(), 0u);
  EXPECT_TRUE(two(0.5f, false).search.pairs().empty()) << "bodies at rest";

  MovingScene m;
  m.add(sheet(10, 1), glm::vec3(0), 0.05f, 0.005f, still);
  const SearchRun self(m, true);
  const std::size_t candidates = self.search.features().size();
  ASSERT_GT(candidates, 0u);
  EXPECT_EQ(self.search.work(), m.traits[0].surface->feature_count() + candidates);
}

/// A surface is cut into patches where a body with it is searched first. Nothing shows of that.
TEST(SurfaceSearch, CandidatesDoNotDependOnWhereASurfaceWasCut) {
  std::mt19937 random(73);
  MovingScene m;
  const glm::vec3 fly(5, -3, 2), spin(1, 4, -2);
  m.add(sheet(10, 1), glm::vec3(0), 0.02f, 0.005f, [&](const glm::vec3& v) {
    return fly + glm::cross(spin, v) + 2.0f * glm::vec3(-v.x, v.x * v.x, 0) + random_points(random, 1, -1, 1)[0];
  });
  SearchRun kept(m, true);
  Workers workers(1);
  std::size_t found = 0;
  for (int i = 0; i < 20; ++i) {
    m.scene = m.after(m.seconds, random);
    kept.search.find({m.scene.frame(), kept.vx, kept.vy, kept.vz}, m.traits, {m.seconds, m.seconds, true}, workers);
    MovingScene other = m;
    const Surface& surface = *other.scene.surfaces[0];
    other.scene.surfaces[0] = std::make_shared<Surface>(surface.vertex_count(), surface.triangles());
    other.traits[0].surface = other.scene.surfaces[0].get();
    const SearchRun fresh(other, true);
    EXPECT_EQ(listed(kept.search), listed(fresh.search)) << i;
    EXPECT_EQ(kept.search.work(), fresh.search.work()) << i;
    found += fresh.search.features().size();
  }
  EXPECT_GT(found, 1000u);
}

TEST(SurfaceSearch, LeavesOutBodiesThatAreNotFinite) {
  std::mt19937 random(63);
  MovingScene m = swarm(random, 1, 0.02f, 0.01f);
  for (SurfaceBody& body : m.traits) body.moves = true;
  m.scene.state.y[m.first(1) + 7] = nan;
  m.velocity[m.first(4)].z = infinity;
  const SearchRun run(m, true);
  ASSERT_FALSE(run.search.features().empty());
  for (const SurfacePair& p : run.search.pairs()) {
    EXPECT_TRUE(p.a != 1 && p.b != 1);
    EXPECT_TRUE(p.a != 4 && p.b != 4);
  }
}

TEST(SurfaceSearch, KeepsPairsWhoseDistanceOverflows) {
  constexpr float size = 1e11f;
  const SurfaceMesh triangle{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}};
  MovingScene m;
  for (const float z : {0.0f, 0.5f}) m.add(triangle, {0, 0, size * z}, 2 * size, 0.1f, still);
  EXPECT_EQ(SearchRun(m, false).search.features().size(), 15u);
}

class SurfaceSearchOnTargets : public OnEveryTarget {};

TEST_P(SurfaceSearchOnTargets, CandidatesDoNotDependOnTargetOrThreads) {
  for (const float speed : {0.5f, 50.0f}) {
    const MovingScene m = swarm(random_, speed, 0.02f, 0.01f);
    hwy::SetSupportedTargetsForTest(HWY_STATIC_TARGET);
    const auto expected = listed(SearchRun(m, true).search);
    hwy::SetSupportedTargetsForTest(GetParam());
    ASSERT_GT(expected.size(), 100u);
    EXPECT_EQ(listed(SearchRun(m, true).search), expected);
    EXPECT_EQ(listed(SearchRun(m, true, 2).search), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, SurfaceSearchOnTargets, testing::ValuesIn(targets()), target_name);

TEST(SurfaceSearch, ListsEachPairOnceInAscendingOrder) {
  std::mt19937 random(64);
  const MovingScene m = swarm(random, 5, 0.02f, 0.01f);
  const SearchRun run(m, true);
  const SurfaceSearch& s = run.search;
  const auto ascends = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i + 1 < end; ++i)
      if (!(s.features()[i].key() < s.features()[i + 1].key())) return false;
    return begin <= end;
  };
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < s.pairs().size(); ++i) {
    const SurfacePair& p = s.pairs()[i];
    EXPECT_EQ(p.vertex_face, next);
    EXPECT_TRUE(ascends(p.vertex_face, p.face_vertex) && ascends(p.face_vertex, p.edge_edge) &&
                ascends(p.edge_edge, p.end));
    next = p.end;
    if (i > 0) {
      EXPECT_LT(std::pair(s.pairs()[i - 1].a, s.pairs()[i - 1].b), std::pair(p.a, p.b));
    }
  }
  EXPECT_EQ(next, s.features().size());
}

TEST(SurfaceSearch, IsValidWhileDeviationsStayWithinTheSlack) {
  std::mt19937 random(66);
  MovingScene m;
  const glm::vec3 velocity(3, -20, 1);
  m.add(ball(0.5f), glm::vec3(0), 0.01f, 0.05f, [&](const glm::vec3&) { return velocity; });
  m.add(ball(0.5f), glm::vec3(0, 1, 0), 0.01f, 0.05f, [&](const glm::vec3&) { return velocity; });
  m.traits[1].moves = false;
  SearchRun run(m, false);
  EXPECT_TRUE(run.search.check_valid(m.after(0.02f, random).frame(), 0.02f));
  EXPECT_FALSE(run.search.check_valid(m.scene.frame(), 0.02f)) << "the body did not move";
  SearchRun again(m, false);
  Scene off = m.scene;
  off.state.x[5] += 0.03f;
  EXPECT_TRUE(again.search.check_valid(off.frame(), 0));
  EXPECT_NEAR(again.search.body(0).deviation(), 0.03f, 1e-6);
  off.state.x[5] += 0.03f;
  EXPECT_FALSE(again.search.check_valid(off.frame(), 0));
  EXPECT_NEAR(again.search.body(0).deviation(), 0.06f, 1e-6);
  EXPECT_EQ(again.search.body(1).deviation(), 0);
  EXPECT_FALSE(again.search.check_valid(m.scene.frame(), 0)) << "once expired, a prediction stays expired";
}

/// Under a constant acceleration the deviation grows with the square of the time.
TEST(SurfaceSearch, HoldsUntilTheDeviationIsLikelyToExceedTheSlack) {
  std::mt19937 random(68);
  MovingScene m;
  m.add(ball(0.5f), glm::vec3(0), 0.01f, 0.05f, [](const glm::vec3&) { return glm::vec3(3, -20, 1); });
  m.seconds = 1;
  SearchRun run(m, false);
  EXPECT_EQ(run.search.holds_until(), run.search.predicted_until());
  Scene off = m.scene;
  const auto fall = [&](float seconds) {
    for (std::size_t i = 0; i < off.state.x.size(); ++i) {
      off.state.x[i] = m.scene.state.x[i] + 3 * seconds;
      off.state.y[i] = m.scene.state.y[i] - 20 * seconds - 500 * seconds * seconds;
      off.state.z[i] = m.scene.state.z[i] + seconds;
    }
  };
  fall(0.002f);
  ASSERT_TRUE(run.search.check_valid(off.frame(), 0.002f));
  EXPECT_NEAR(run.search.holds_until(), 0.01f, 1e-5);
  fall(0.0101f);
  EXPECT_FALSE(run.search.check_valid(off.frame(), 0.0101f));
}

TEST(SurfaceSearch, MaxRelativeSpeedBoundsAllVerticesOfAPair) {
  std::mt19937 random(67);
  const MovingScene m = swarm(random, 5, 0.02f, 0.01f);
  const SearchRun run(m, false);
  ASSERT_FALSE(run.search.pairs().empty());
  for (const SurfacePair& p : run.search.pairs()) {
    const auto speed = [&](Index body, Index v) { return m.traits[body].moves ? m.velocity[v] : glm::vec3(0); };
    float largest = 0;
    for (Index v = m.first(p.a); v < m.first(p.a + 1); ++v)
      for (Index w = m.first(p.b); w < m.first(p.b + 1); ++w)
        largest = std::max(largest, glm::length(speed(p.a, v) - speed(p.b, w)));
    EXPECT_LE(largest, run.search.max_relative_speed(p.a, p.b) * 1.00001f);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
