// Which bodies cannot touch themselves while they move.

#include "collide/surface/swept_body.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "moving_surfaces.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;
namespace THIS_FILE {

/// Dented balls with more and more deformation. Those that stay star-shaped must not pierce themselves at any time.
TEST(SweptBody, BodiesThatStayStarShapedDoNotPierceThemselves) {
  std::mt19937 random(65);
  int star_shaped = 0, pierced = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const float dent = uniform(random, 0, 0.5f), share = uniform(random, 0, 1),
                deformation = 20 * share * share * share, slack = uniform(random, 0, 0.002f);
    SurfaceMesh mesh = ball(0.5f, 1);
    for (glm::vec3& v : mesh.vertices) v *= uniform(random, 1 - dent, 1);
    const std::vector<glm::vec3> r = random_points(random, 3, -100, 100);
    MovingScene m;
    m.add(mesh, r[0], 0.01f, slack, [&](const glm::vec3& v) {
      return r[1] + 0.1f * glm::cross(r[2], v) + deformation * random_points(random, 1, -1, 1)[0];
    });
    const bool star = SearchRun(m, true).search.body(0).stays_star_shaped();
    star_shaped += star;
    bool pierces = false;
    for (const float when : {0.0f, 0.3f, 0.6f, 1.0f})
      pierces = pierces || figures_of(m.after(when * m.seconds, random)).self_intersecting_bodies > 0;
    pierced += pierces;
    EXPECT_FALSE(star && pierces) << trial;
  }
  EXPECT_GT(star_shaped, 20) << pierced;
  EXPECT_GT(pierced, 20) << star_shaped;
}

TEST(SweptBody, DetectsBodiesThatAreNotStarShaped) {
  const auto star_shaped = [](const SurfaceMesh& mesh, float slack = 0.001f) {
    MovingScene m;
    m.add(mesh, glm::vec3(3, 1, 2), 0.01f, slack, still);
    return SearchRun(m, true).search.body(0).stays_star_shaped();
  };
  EXPECT_TRUE(star_shaped(ball(1)));
  for (const glm::vec3& axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 2, 3)})
    for (int i = 0; i < 24; ++i)
      EXPECT_TRUE(star_shaped(turned(ball(1), axis, glm::radians(15.0f * float(i))))) << "corners lie along axes";
  EXPECT_FALSE(star_shaped(ball(1), 0.5f)) << "vertices may deviate so far that faces turn over";
  EXPECT_FALSE(star_shaped(valley()));
  SurfaceMesh inverted = ball(1);
  for (Triangle& f : inverted.triangles) std::swap(f[1], f[2]);
  EXPECT_FALSE(star_shaped(inverted));
  SurfaceMesh twice = ball(1), second = turned(ball(0.95f), glm::vec3(1, 2, 3), 0.5f);  // one inside the other
  for (const Triangle& f : second.triangles) twice.triangles.push_back({f[0] + 162, f[1] + 162, f[2] + 162});
  twice.vertices.insert(twice.vertices.end(), second.vertices.begin(), second.vertices.end());
  EXPECT_FALSE(star_shaped(twice)) << "every face points outwards, but the surface winds around the centre twice";
}

/// What turns only deforms at no speed, whatever its shape: its features come no closer to each other.
TEST(SweptBody, TakesAnyTurnForRigidMotion) {
  std::mt19937 random(66);
  const SurfaceMesh line{{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}, {{0, 1, 2}}};
  for (const SurfaceMesh& mesh : {valley(), sheet(10, 1), box({0, 0, 0}, {10, 1, 0.1f}), line}) {
    const std::vector<glm::vec3> r = random_points(random, 2, -5, 5);
    MovingScene m;
    m.add(mesh, glm::vec3(3, 1, 2), 0.01f, 0.001f, [&](const glm::vec3& v) { return r[0] + glm::cross(r[1], v); });
    const SearchRun run(m, true);
    EXPECT_LT(run.search.body(0).max_deformation_speed(), 1e-4f * run.search.body(0).velocity_spread());
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
