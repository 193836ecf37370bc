// What the search for surface contact says beside its candidates: which bodies cannot touch themselves, and for how
// long the candidates hold.

#include <gtest/gtest.h>

#include "moving_surfaces.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;
namespace {

/// Dented balls that are strained more and more: those that are not looked into must not pierce themselves at any time.
TEST(SurfaceSearch, StarShapedBodiesNeverPierceThemselves) {
  std::mt19937 random(65);
  int skipped = 0, pierced = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const float dent = uniform(random, 0, 0.5f), part = uniform(random, 0, 1), strain = 20 * part * part * part,
                slack = uniform(random, 0, 0.002f);
    SurfaceMesh mesh = ball(0.5f, 1);
    for (glm::vec3& v : mesh.vertices) v *= uniform(random, 1 - dent, 1);
    const std::vector<glm::vec3> r = random_points(random, 3, -100, 100);
    Moving m;
    m.add(mesh, r[0], 0.01f, slack, [&](const glm::vec3& v) {
      return r[1] + 0.1f * glm::cross(r[2], v) + strain * random_points(random, 1, -1, 1)[0];
    });
    const bool star = Found(m, true).search.body(0).unfolded();
    skipped += star;
    bool pierces = false;
    for (const float when : {0.0f, 0.3f, 0.6f, 1.0f})
      pierces = pierces || figures_of(m.after(when * m.seconds, random)).self_intersecting_bodies > 0;
    pierced += pierces;
    EXPECT_FALSE(star && pierces) << trial;
  }
  EXPECT_GT(skipped, 20) << pierced;
  EXPECT_GT(pierced, 20) << skipped;
}

TEST(SurfaceSearch, BodiesThatAreNoStarAreLookedInto) {
  const auto unfolded = [](const SurfaceMesh& mesh, float slack = 0.001f) {
    Moving m;
    m.add(mesh, glm::vec3(3, 1, 2), 0.01f, slack, [](const glm::vec3&) { return glm::vec3(0); });
    return Found(m, true).search.body(0).unfolded();
  };
  EXPECT_TRUE(unfolded(ball(1)));
  EXPECT_FALSE(unfolded(ball(1), 0.5f)) << "vertices may stray so far that faces turn round";
  EXPECT_FALSE(unfolded(valley()));
  SurfaceMesh inverted = ball(1);
  for (Triangle& f : inverted.triangles) std::swap(f[1], f[2]);
  EXPECT_FALSE(unfolded(inverted));
  SurfaceMesh twice = ball(1), second = turned(ball(0.95f), glm::vec3(1, 2, 3), 0.5f);  // one in the other
  for (const Triangle& f : second.triangles) twice.triangles.push_back({f[0] + 162, f[1] + 162, f[2] + 162});
  twice.vertices.insert(twice.vertices.end(), second.vertices.begin(), second.vertices.end());
  EXPECT_FALSE(unfolded(twice)) << "every face looks outwards, but the surface winds around the middle twice";
}

TEST(SurfaceSearch, HoldsWhileNoVertexStraysBeyondTheSlack) {
  std::mt19937 random(66);
  Moving m;
  const glm::vec3 fly(3, -20, 1);
  m.add(ball(0.5f), glm::vec3(0), 0.01f, 0.05f, [&](const glm::vec3&) { return fly; });
  m.add(ball(0.5f), glm::vec3(0, 1, 0), 0.01f, 0.05f, [&](const glm::vec3&) { return fly; });
  m.traits[1].moves = false;
  Found found(m, false);
  EXPECT_TRUE(found.search.holds(m.after(0.02f, random).frame(), 0.02f));
  EXPECT_FALSE(found.search.holds(m.scene.frame(), 0.02f)) << "it did not move";
  Found again(m, false);
  Scene off = m.after(0, random);
  off.state.x = m.scene.state.x, off.state.y = m.scene.state.y, off.state.z = m.scene.state.z;
  off.state.x[5] += 0.03f;
  EXPECT_TRUE(again.search.holds(off.frame(), 0));
  EXPECT_NEAR(again.search.body(0).stray(), 0.03f, 1e-6);
  off.state.x[5] += 0.03f;
  EXPECT_FALSE(again.search.holds(off.frame(), 0));
  EXPECT_NEAR(again.search.body(0).stray(), 0.06f, 1e-6);
  EXPECT_EQ(again.search.body(1).stray(), 0);
  EXPECT_FALSE(again.search.holds(m.scene.frame(), 0)) << "what was off has not been foreseen";
}

}  // namespace
}  // namespace collide::test
