// The candidates of surface contact: which pairs may be solved side by side, how fast two bodies may meet, and which
// bodies are moved apart as a whole.

#include "softbody/contact/surface_candidates.h"

#include <gtest/gtest.h>

#include <set>

namespace softbody::test {
namespace THIS_FILE {

struct Ball {
  glm::vec3 position, velocity{0.0f};  // m, m/s
};

/// The candidates of balls of radius 0.5 m, which are flattened to a share `height` of that along y.
SurfaceCandidates candidates_of(const std::vector<Ball>& balls, const collide::surface::Surface& surface,
                                const Mesh& mesh, float height = 1) {
  constexpr float seconds = 0.01f, mean_edge = 0.3f;
  std::array<std::vector<float>, 3> at, speed;
  collide::Bodies list;
  std::vector<collide::surface::SurfaceBody> traits;
  std::vector<ContactBody> bodies;
  const auto shape = std::make_shared<const collide::Shape>(surface.vertex_count(), surface.edges());
  for (const Ball& ball : balls) {
    for (const glm::dvec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) {
        at[std::size_t(k)].push_back(ball.position[k] + (k == 1 ? height : 1.0f) * float(v[k]));
        speed[std::size_t(k)].push_back(ball.velocity[k]);
      }
    list.add(shape);
    traits.push_back({.surface = &surface, .skin = 0.005f, .mean_edge = mean_edge, .moves = true});
    bodies.push_back({.inverse_mass = 1});
  }
  collide::Workers workers(1);
  SurfaceCandidates candidates;
  candidates.find({{at[0], at[1], at[2], &list}, speed[0], speed[1], speed[2]}, traits, bodies,
                  {.seconds = seconds, .min_seconds = seconds}, seconds, workers);
  return candidates;
}

class CandidatesOfBalls : public testing::Test {
 protected:
  const Mesh mesh = icosphere(2, 0.5);
  const collide::surface::Surface surface{Index(mesh.vertices.size()), mesh.triangles};
};

/// The two outer balls touch the one between them, which has the last number.
TEST_F(CandidatesOfBalls, HaveNoBodyInTwoPairsOfOneColour) {
  const SurfaceCandidates found = candidates_of({{{0, 0, 0}}, {{2.02f, 0, 0}}, {{1.01f, 0, 0}}}, surface, mesh);
  ASSERT_EQ(found.pairs().size(), 2u);
  std::size_t pairs = 0;
  for (const auto& colour : found.colours()) {
    std::set<Index> bodies;
    for (const std::uint32_t i : colour)
      for (const Index body : {found.pairs()[i].range.a, found.pairs()[i].range.b})
        EXPECT_TRUE(bodies.insert(body).second) << "body " << body;
    pairs += colour.size();
  }
  EXPECT_EQ(pairs, 2u);
}

/// The first ball may hit the third through the second within one substep.
TEST_F(CandidatesOfBalls, ExpectOfEachPairTheFastestOfEitherBody) {
  const SurfaceCandidates found =
      candidates_of({{{0, 0, 0}, {10, 0, 0}}, {{1.01f, 0, 0}}, {{2.02f, 0, 0}}}, surface, mesh);
  ASSERT_EQ(found.pairs().size(), 2u);
  for (const SurfaceCandidates::Pair& pair : found.pairs()) EXPECT_GT(pair.speed, 9.9f) << "m/s, " << pair.range.a;
  EXPECT_NEAR(found.substep_rate(), 10 / (0.15 * 0.3), 5) << "they pass each other by 0.15 of an edge in a substep";
}

/// No vertex of bodies as flat as these is deep: where they are in one place, their surfaces face the same way.
TEST_F(CandidatesOfBalls, AreMovedApartAsAWholeWhereTheyAreInOnePlace) {
  for (const float above : {0.001f, 0.0495f}) {
    const SurfaceCandidates found = candidates_of({{{0, 0, 0}}, {{0, above, 0}}}, surface, mesh, 0.05f);
    ASSERT_EQ(found.pairs().size(), 1u);
    EXPECT_TRUE(found.pairs()[0].overlap) << above;
    EXPECT_EQ(found.pairs()[0].separating, above < 0.01f) << above;
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
