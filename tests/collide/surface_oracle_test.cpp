// What overlaps and crossings have in common: figures, missed contacts, order, threads, and input that is rejected or
// left out.

#include "collide/oracle/surface_oracle.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "surface_meshes.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;
namespace THIS_FILE {

/// Returns a heap of balls, each a little inside its neighbours. motion: m, how far each is displaced at random.
Scene heap(float motion) {
  std::mt19937 random(27);
  Scene scene;
  for (int i = 0; i < 27; ++i) {
    const auto at = [&](int k) { return 0.9f * static_cast<float>(k) + uniform(random, -0.02f, 0.02f); };
    const float x = at(i % 3), y = at(i / 3 % 3), z = at(i / 9);
    scene.add(moved(ball(0.5f), glm::vec3(x, y, z) + motion * random_points(random, 1, -1, 1)[0]));
  }
  return scene;
}

TEST(SurfaceOracle, ResultsDoNotDependOnThreads) {
  const Scene before = heap(0), after = heap(0.2f);
  const Overlaps one = overlaps_of(after, 1), three = overlaps_of(after, 3);
  ASSERT_GT(one.penetrations.size(), 50u);
  ASSERT_GT(one.piercings.size(), 100u);
  EXPECT_TRUE(one.penetrations == three.penetrations);
  EXPECT_TRUE(one.piercings == three.piercings);
  const std::vector<Crossing> by_one = crossings_of(before, after, 1);
  ASSERT_GT(by_one.size(), 100u);
  EXPECT_TRUE(by_one == crossings_of(before, after, 3));
}

TEST(SurfaceOracle, FiguresCountEachItemOnce) {
  const Bodies bodies = [] {
    Bodies all;
    for (int body = 0; body < 3; ++body) all.add(std::make_shared<const Shape>(10, std::span<const Edge>{}));
    return all;
  }();
  const Frame frame{{}, {}, {}, &bodies};
  Overlaps overlaps;
  overlaps.penetrations = {{3, 1, 0, 0.5, {}, {}}, {3, 2, 0, 1.5, {}, {}}, {12, 0, 0, 1, {}, {}}};
  overlaps.piercings = {{{1, 2}, 0, 2, 0, {}}, {{21, 22}, 2, 2, 0, {}}, {{21, 23}, 2, 2, 0, {}}};
  constexpr Crossing::Kind vertex_face = Crossing::Kind::vertex_face, edge_edge = Crossing::Kind::edge_edge;
  const std::vector<Crossing> crossings{{{vertex_face, {5, 5}, {10, 11, 12}}, 0, 1, 0, true},
                                        {{vertex_face, {5, 5}, {11, 12, 13}}, 0, 1, 0, true},
                                        {{edge_edge, {10, 11}, {20, 21, 21}}, 1, 2, 0, true}};
  const SurfaceFigures figures = figures_of(frame, overlaps, crossings);
  EXPECT_EQ(figures, (SurfaceFigures{.penetrating_vertices = 2,
                                     .overlapping_pairs = 2,
                                     .self_intersecting_bodies = 1,
                                     .deepest = 1.5,
                                     .mean_depth = 1,
                                     .piercings = 3,
                                     .crossed_vertices = 1,
                                     .edge_crossings = 1}));
  EXPECT_EQ(overlapping_pairs(frame, overlaps), (std::vector<OverlappingPair>{{0, 1}, {0, 2}, {2, 2}}));
}

TEST(SurfaceOracle, MissedListsTheOverlapsThatContactsDoNotShow) {
  // The tip of a tetrahedron (vertex 8) in the upper face of a cube.
  const SurfaceMesh tetrahedron{{{2, 3.5f, 2}, {1, 5, 1}, {3, 5, 1.5f}, {2, 5, 3}},
                                {{1, 3, 2}, {0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};
  const Scene scene{box(glm::vec3(0), glm::vec3(4)), tetrahedron};
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_EQ(overlaps.penetrations.size(), 1u);
  const Index in = overlaps.penetrations[0].vertex;
  ASSERT_EQ(in, 8u);
  ASSERT_GE(overlaps.piercings.size(), 3u);

  const auto missed = [&](const std::vector<Contact>& contacts) {
    return missed_by(contacts, scene.frame(), scene.surfaces, overlaps);
  };
  const Missed all = missed({});
  EXPECT_EQ(all.penetrations.size(), 1u);
  EXPECT_EQ(all.piercings.size(), overlaps.piercings.size());
  EXPECT_EQ(all.pairs, (std::vector<OverlappingPair>{{0, 1}}));

  const Missed pair_seen = missed({{0, 9}});
  EXPECT_EQ(pair_seen.penetrations.size(), 1u);
  EXPECT_TRUE(pair_seen.pairs.empty());
  EXPECT_EQ(missed({{0, 1}, {8, 9}}).pairs.size(), 1u);  // contacts inside one body do not show it

  std::vector<Contact> corners;
  for (Index v = 0; v < 8; ++v) corners.push_back({v, in});
  EXPECT_TRUE(missed(corners).penetrations.empty());
  EXPECT_LT(missed(corners).piercings.size(), overlaps.piercings.size());
}

TEST(SurfaceOracle, AnyContactOfAnEndWithACornerShowsAPiercing) {
  const Scene scene{box(glm::vec3(0), glm::vec3(4)), moved(box(glm::vec3(0), glm::vec3(4)), glm::vec3(1, 2, 1.5f))};
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_GE(overlaps.piercings.size(), 3u);
  for (std::size_t i = 0; i < overlaps.piercings.size(); ++i) {
    const Piercing& through = overlaps.piercings[i];
    const Index first = scene.state.bodies.first[through.triangle_body];
    for (const Index end : through.edge)
      for (const Index v : scene.surfaces[through.triangle_body]->triangles()[through.triangle]) {
        const std::vector<Contact> one{{std::min(end, first + v), std::max(end, first + v)}};
        const Missed missed = missed_by(one, scene.frame(), scene.surfaces, overlaps);
        EXPECT_EQ(std::count(missed.piercings.begin(), missed.piercings.end(), i), 0) << end << ' ' << v;
      }
  }
}

TEST(SurfaceOracle, LeavesOutBodiesThatAreNotFinite) {
  Scene scene{ball(1), moved(ball(1), glm::vec3(1, 0, 0)), moved(ball(1), glm::vec3(0, 1, 0))};
  const Scene before = scene;
  scene.state.x[5] = std::numeric_limits<float>::quiet_NaN();
  scene.state.y[162 + 5] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(figures_of(before, scene), SurfaceFigures{});
  EXPECT_EQ(figures_of(before).overlapping_pairs, 3u);
}

TEST(SurfaceOracle, WorksOverTheWholeRangeOfFloats) {
  for (const float scale : {1e-30f, 1e30f, 3e38f}) {
    const Scene scene{box(glm::vec3(-scale), glm::vec3(scale)), box(glm::vec3(0), glm::vec3(scale / 2))};
    const SurfaceFigures figures = figures_of(scene);
    EXPECT_EQ(figures.penetrating_vertices, 8u) << scale;
    EXPECT_NEAR(figures.deepest / double{scale}, 1, 1e-6);
    const Scene out{box(glm::vec3(-scale), glm::vec3(scale)), box(glm::vec3(-scale), glm::vec3(-scale / 2))};
    EXPECT_EQ(figures_of(out, scene).crossed_vertices, 7u) << scale;  // all that were on the faces, and so outside
  }
}

TEST(SurfaceOracle, ThrowsIfSurfacesAndBodiesDoNotMatch) {
  const Scene two{ball(1), ball(1)}, one{ball(1)}, coarse{ball(1, 1)};
  Workers workers(1);
  EXPECT_THROW(find_overlaps(two.frame(), one.surfaces, workers), std::invalid_argument);
  EXPECT_THROW(find_overlaps(one.frame(), coarse.surfaces, workers), std::invalid_argument);
  EXPECT_THROW(find_crossings(one.frame(), coarse.frame(), one.surfaces, workers), std::invalid_argument);
}

}  // namespace THIS_FILE
}  // namespace collide::test
