// The candidates of surface contact: their order, how many, and of which bodies there are none.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <stdexcept>

#include "every_target.h"
#include "moving_surfaces.h"

namespace collide::test {

using namespace collide::surface;
namespace {

/// Everything that was found, as numbers that can be compared.
std::vector<std::array<float, 8>> listed(const SurfaceSearch& search) {
  std::vector<std::array<float, 8>> list;
  for (const SurfacePair& p : search.pairs())
    for (std::uint32_t i = p.vertex_face; i < p.end; ++i) {
      const FeaturePair& f = search.features()[i];
      list.push_back({float(p.a), float(p.b), float(p.vertex_face), float(p.face_vertex), float(p.edge_edge),
                      float(f.a), float(f.b), f.from});
    }
  return list;
}

TEST(SurfaceSearch, RefusesMoreThanMayBe) {
  std::mt19937 random(72);
  const Moving m = swarm(random, 5, 0.02f, 0.01f);
  Found found(m, true);
  const std::size_t all = found.search.features().size();
  const auto find = [&](std::size_t most) {
    Workers workers(2);
    found.search.find({m.scene.frame(), found.vx, found.vy, found.vz}, m.traits, {m.seconds, m.seconds, true, most},
                      workers);
    return found.search.features().size();
  };
  EXPECT_THROW(find(all - 1), std::length_error);
  EXPECT_THROW(find(all / 4), std::length_error);
  EXPECT_EQ(find(all), all);
}

TEST(SurfaceSearch, AFlightBringsNoCandidatesWithinABody) {
  const auto candidates = [](const glm::vec3& fly) {
    Moving m;
    m.add(sheet(10, 1), glm::vec3(0), 0.05f, 0.005f, [&](const glm::vec3&) { return fly; });
    return Found(m, true).search.features().size();
  };
  const std::size_t at_rest = candidates(glm::vec3(0));
  ASSERT_GT(at_rest, 0u);
  EXPECT_EQ(candidates({128, -64, 32}), at_rest);
}

TEST(SurfaceSearch, BodiesFarApartHaveNoCandidates) {
  Moving m;
  const auto still = [](const glm::vec3&) { return glm::vec3(0); };
  m.add(ball(0.5f), glm::vec3(0), 0.01f, 0.01f, still);
  m.add(ball(0.5f), glm::vec3(1.2f, 0, 0), 0.01f, 0.01f, still);
  EXPECT_TRUE(Found(m, false).search.features().empty());
  m.traits[0].moves = m.traits[1].moves = false;
  m.scene = Scene{ball(0.5f), ball(0.5f)};
  EXPECT_TRUE(Found(m, true).search.pairs().empty()) << "nor have those that stand, wherever they are";
}

TEST(SurfaceSearch, ABodyInsideAnotherMakesAPairWithoutCandidatesWhicheverComesFirst) {
  const auto still = [](const glm::vec3&) { return glm::vec3(0); };
  for (const auto& [first, second] : {std::pair(0.5f, 0.1f), std::pair(0.1f, 0.5f)}) {
    Moving m;
    for (const float radius : {first, second}) m.add(ball(radius), glm::vec3(0), 0.01f, 0.01f, still);
    const Found found(m, false);
    EXPECT_TRUE(found.search.features().empty());
    ASSERT_EQ(found.search.pairs().size(), 1u) << first;
    EXPECT_EQ(found.search.pairs()[0].bodies(), (std::pair<Index, Index>(0, 1)));
  }
}

TEST(SurfaceSearch, CountsWhatItLooksAt) {
  const auto still = [](const glm::vec3&) { return glm::vec3(0); };
  const SurfaceMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto two = [&](float apart) {
    Moving m;
    for (const float z : {0.0f, apart}) m.add(triangle, {0, 0, z}, 2, 0.1f, still);
    return Found(m, false);
  };
  // 14 features; of their boxes 6 pairs of a vertex and a face and 9 of edges, which are all candidates.
  EXPECT_EQ(two(0.5f).search.features().size(), 15u);
  EXPECT_EQ(two(0.5f).search.work(), 14u + 15u + 15u);
  EXPECT_EQ(two(50).search.work(), 0u);

  Moving m;
  m.add(sheet(10, 1), glm::vec3(0), 0.05f, 0.005f, still);
  const Found with_itself(m, true);
  const Surface& surface = *m.traits[0].surface;
  const std::size_t candidates = with_itself.search.features().size(), touching = 3 * surface.triangles().size();
  ASSERT_GT(candidates, 0u);
  EXPECT_GE(with_itself.search.work(), surface.feature_count() + touching + 2 * candidates)
      << "faces and their corners";
}

TEST(SurfaceSearch, LeavesOutBodiesThatAreNotFinite) {
  std::mt19937 random(63);
  Moving m = swarm(random, 1, 0.02f, 0.01f);
  for (SurfaceBody& body : m.traits) body.moves = true;
  m.scene.state.y[m.first(1) + 7] = nan;
  m.velocity[m.first(4)].z = infinity;
  const Found found(m, true);
  ASSERT_FALSE(found.search.features().empty());
  for (const SurfacePair& p : found.search.pairs()) {
    EXPECT_TRUE(p.a != 1 && p.b != 1);
    EXPECT_TRUE(p.a != 4 && p.b != 4);
  }
}

class SurfaceSearchOnTargets : public OnEveryTarget {};

TEST_P(SurfaceSearchOnTargets, TheCandidatesAreTheSameAndThoseOfTwoThreads) {
  for (const float speed : {0.5f, 50.0f}) {
    const Moving m = swarm(random_, speed, 0.02f, 0.01f);
    hwy::SetSupportedTargetsForTest(HWY_STATIC_TARGET);
    const auto expected = listed(Found(m, true).search);
    hwy::SetSupportedTargetsForTest(GetParam());
    ASSERT_GT(expected.size(), 100u);
    EXPECT_EQ(listed(Found(m, true).search), expected);
    EXPECT_EQ(listed(Found(m, true, 2).search), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, SurfaceSearchOnTargets, testing::ValuesIn(targets()), target_name);

TEST(SurfaceSearch, ComesInAscendingOrderEachPairOnce) {
  std::mt19937 random(64);
  const Moving m = swarm(random, 5, 0.02f, 0.01f);
  const Found found(m, true);
  const SurfaceSearch& s = found.search;
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

TEST(SurfaceSearch, SpeedBoundsTheRelativeSpeedOfAPairsVertices) {
  std::mt19937 random(67);
  const Moving m = swarm(random, 5, 0.02f, 0.01f);
  const Found found(m, false);
  ASSERT_FALSE(found.search.pairs().empty());
  for (const SurfacePair& p : found.search.pairs()) {
    const auto speed = [&](Index body, Index v) { return m.traits[body].moves ? m.velocity[v] : glm::vec3(0); };
    float most = 0;
    for (Index v = m.first(p.a); v < m.first(p.a + 1); ++v)
      for (Index w = m.first(p.b); w < m.first(p.b + 1); ++w)
        most = std::max(most, glm::length(speed(p.a, v) - speed(p.b, w)));
    EXPECT_LE(most, found.search.speed(p) * 1.00001f);
  }
}

}  // namespace
}  // namespace collide::test
