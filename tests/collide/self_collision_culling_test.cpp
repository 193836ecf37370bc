// Of a body's own pairs, those that the proof leaves out are farther apart than the reach, whatever the body looks
// like.

#include "collide/exact/self_collision_culling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>

#include "collide/core/cutoff.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

/// One deformation of a sphere of radius 1.
std::vector<glm::vec3> deformed(std::vector<glm::vec3> points, int kind, std::mt19937& random) {
  const float by = uniform(random, 0, 1);
  const glm::vec3 stretch = random_points(random, 1, 0.1f, 2)[0];
  const glm::vec3 aslant = glm::normalize(random_points(random, 1, 0.1f, 1)[0]);
  const std::size_t dent = random() % points.size();
  const glm::vec3 towards = points[random() % points.size()];
  for (std::size_t v = 0; v < points.size(); ++v) {
    glm::vec3& p = points[v];
    switch (kind) {
      case 0:  // a little noise
        p += random_points(random, 1, -0.1f * by, 0.1f * by)[0];
        break;
      case 1:  // stretched and squeezed
        p *= stretch;
        break;
      case 2:  // flattened, aslant
        p -= (1 - 0.3f * by) * glm::dot(p, aslant) * aslant;
        break;
      case 3:  // inside out
        p *= -stretch;
        break;
      case 4:  // folded
        if (p.x > by - 0.5f) p.x = 2 * (by - 0.5f) - p.x;
        break;
      case 5:  // collapsed
        p *= 1e-3f * by;
        break;
      case 6:  // one vertex torn through the body
        if (v == dent) p = towards + random_points(random, 1, -0.02f, 0.02f)[0];
        break;
      case 7:  // twisted
        p = glm::vec3(p.x * std::cos(4 * by * p.y) - p.z * std::sin(4 * by * p.y), p.y,
                      p.x * std::sin(4 * by * p.y) + p.z * std::cos(4 * by * p.y));
        break;
      case 8:  // a dent
        if (p.y > 0.8f) p.y -= 2 * by;
        break;
      default:  // nothing is left
        p = random_points(random, 1, -1, 1)[0];
    }
  }
  return points;
}

/// Counts the bodies that are culled; fails where a pair that is left out is a contact.
int culled(const CullingReference& reference, const Topology& topology, const std::vector<glm::vec3>& points,
           float tolerance) {
  const Points3 body(points);
  CullingReference::Scratch scratch;
  const SelfCollisionCandidates risk = reference.candidates_of(body.run(), measure_bounds(body.run()), scratch);
  if (!risk.culled) return 0;
  const std::set<std::array<Index, 2>> listed(risk.pairs.begin(), risk.pairs.end());
  const std::set<Index> outliers(risk.outliers.begin(), risk.outliers.end());
  for (Index i = 0; i < points.size(); ++i) {
    for (Index j = i + 1; j < points.size(); ++j) {
      if (!(squared_distance(body.x[i], body.y[i], body.z[i], body.x[j], body.y[j], body.z[j]) <
            tolerance * tolerance)) {
        continue;
      }
      if (topology.joined(i, j) || listed.contains({i, j}) || outliers.contains(i) || outliers.contains(j)) continue;
      ADD_FAILURE() << i << " and " << j << " are in contact and left out";
      return 1;
    }
  }
  return 1;
}

class SelfCollisionCullingOnTargets : public OnEveryTarget {};

TEST_P(SelfCollisionCullingOnTargets, LeavesOutNoContact) {
  for (const int subdivisions : {1, 2}) {
    const Ball ball = icosphere(subdivisions, 1);
    const Topology topology(static_cast<Index>(ball.vertices.size()), ball.edges);
    std::mt19937 random(61);
    std::array<int, 10> count{};
    for (const float tolerance : {0.02f, 0.1f, 0.2f, 0.4f}) {
      const Points3 rest(ball.vertices);
      const CullingReference reference(rest.run(), topology, contact_cutoff(tolerance));
      ASSERT_TRUE(reference.usable());
      for (int kind = 0; kind < 10; ++kind) {
        for (int trial = 0; trial < 40; ++trial) {
          const glm::vec3 at = random_points(random, 1, -50, 50)[0];
          count[static_cast<std::size_t>(kind)] +=
              culled(reference, topology, moved(deformed(ball.vertices, kind, random), at), tolerance);
        }
      }
    }
    EXPECT_GT(count[0], 80) << "noise";
    EXPECT_GT(count[1], 40) << "stretched";
    EXPECT_GT(count[3], 40) << "inside out";
    EXPECT_EQ(count[5], 0) << "collapsed";
    EXPECT_EQ(count[9], 0) << "random";
    if (subdivisions == 2) {
      EXPECT_GT(count[6], 80) << "torn: a few outliers";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, SelfCollisionCullingOnTargets, testing::ValuesIn(targets()), target_name);

/// Exactly as near as the proof allows: two vertices of an affine image, moved together by what may be left.
TEST(SelfCollisionCulling, HoldsAtItsLimit) {
  const Ball ball = icosphere(2, 1);
  const Topology topology(162, ball.edges);
  const Points3 rest(ball.vertices);
  std::mt19937 random(62);
  int proofs = 0;
  for (const float tolerance : {0.05f, 0.2f}) {
    const CullingReference reference(rest.run(), topology, contact_cutoff(tolerance));
    for (int trial = 0; trial < 3000; ++trial) {
      std::vector<glm::vec3> points = ball.vertices;
      const Index i = random() % 162, j = random() % 162;
      const glm::vec3 d = points[j] - points[i];
      const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      if (length == 0) continue;
      const float together = (length - tolerance * uniform(random, 0.9f, 0.9999f)) / 2 / length;
      points[i] += d * together;
      points[j] -= d * together;
      proofs += culled(reference, topology, points, tolerance);
    }
  }
  EXPECT_GT(proofs, 1000);
}

TEST(SelfCollisionCulling, HoldsWhereSquaresUnderflowOrOverflow) {
  const Ball ball = icosphere(1, 1);
  const Topology topology(42, ball.edges);
  std::mt19937 random(63);
  const auto scaled = [](std::vector<glm::vec3> points, float by) {
    for (glm::vec3& p : points) p *= by;
    return points;
  };
  for (const float scale : {1e-22f, 1e-20f, 1e-19f, 1e-18f, 1e17f, 1e18f, 1e19f, 3e19f, 1e25f}) {
    const Points3 rest(scaled(ball.vertices, scale));
    const CullingReference reference(rest.run(), topology, contact_cutoff(0.2f * scale));
    for (int trial = 0; reference.usable() && trial < 200; ++trial)
      culled(reference, topology, scaled(deformed(ball.vertices, trial % 10, random), scale), 0.2f * scale);
  }
}

/// One vertex of it is torn off, and squares are near the end of the range.
TEST(SelfCollisionCulling, HoldsForABodyFarLargerThanItsReference) {
  const Ball ball = icosphere(2, 1);
  const Topology topology(162, ball.edges);
  const Points3 rest(ball.vertices);
  const CullingReference reference(rest.run(), topology, contact_cutoff(0.1f));
  std::vector<glm::vec3> points = ball.vertices;
  for (glm::vec3& p : points) p *= 5e18f;
  const Index unsampled = 20;  // not one of for_samples()
  points[unsampled] = *std::ranges::min_element(
      points, {}, [at = points[unsampled]](const glm::vec3& p) { return glm::dot(p, at); });  // the opposite one
  culled(reference, topology, points, 0.1f);
}

TEST(SelfCollisionCulling, RefusesReferencesOfNoUse) {
  Ball ball = icosphere(2, 1);
  const Topology topology(162, ball.edges);
  const auto usable = [&](const std::vector<glm::vec3>& points) {
    const Points3 body(points);
    return CullingReference(body.run(), topology, 0.1f).usable();
  };
  EXPECT_TRUE(usable(ball.vertices));
  for (Index v = 0; v < 162; ++v) {
    for (const float bad : {nan, infinity}) {
      std::vector<glm::vec3> broken = ball.vertices;
      broken[v].y = bad;
      EXPECT_FALSE(usable(broken)) << v;
    }
  }
  std::vector<glm::vec3> flat = ball.vertices;
  for (glm::vec3& p : flat) p.z = 1;
  EXPECT_FALSE(usable(flat));
  EXPECT_FALSE(usable({ball.vertices.begin(), ball.vertices.begin() + 15}));
}

/// Bodies without rest positions are compared with the first one of their topology, if there are enough. Of the last
/// one a vertex is torn off: it is tested with all others.
TEST(SelfCollisionCulling, TakesItsReferenceFromAFrame) {
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(Index{162}, ball.edges);
  for (const std::size_t bodies : {2u, 3u}) {
    State state;
    for (std::size_t i = 0; i < bodies; ++i)
      state.add(shape, moved(ball.vertices, glm::vec3(2.0f * static_cast<float>(i), 0, 0)));
    const std::size_t torn = state.x.size() - 162 + 20, other = state.x.size() - 162 + 40;
    state.x[torn] = state.x[other], state.y[torn] = state.y[other], state.z[torn] = state.z[other];
    Result result = detect("multi-level-sb-exact", state, {});
    EXPECT_EQ(result.skip(Skip::unfolded_bodies), bodies >= 3 ? 2u : 0u);
    EXPECT_EQ(result.contacts, oracle(state, {}));
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
