#include "app/compare/pair_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace app {
namespace THIS_FILE {

/// Vertices in a box of 2 m x 1 m x 1 m, in bodies of the same size.
struct Cloud {
  explicit Cloud(collide::Index vertices, collide::Index bodies_count = 1) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(0, 1);
    for (collide::Index v = 0; v < vertices; ++v) {
      x.push_back(2 * place(random));
      y.push_back(place(random));
      z.push_back(place(random));
    }
    const std::vector<std::array<collide::Index, 2>> no_edges;
    for (collide::Index b = 0; b < bodies_count; ++b)
      bodies.add(std::make_shared<collide::Shape>(vertices / bodies_count, no_edges));
  }
  collide::Frame view() const { return {x, y, z, &bodies}; }

  /// Returns the share of pairs of which one vertex is in a cell that comes within `reach` of the other one, over many
  /// origins of the grid.
  double meeting(const glm::dvec3& cell, double reach) const {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> shift(0, 1);
    std::size_t meet = 0, all = 0;
    for (int origin = 0; origin < 20; ++origin) {
      const glm::dvec3 at(shift(random), shift(random), shift(random));
      const auto near = [&](double a, double b, int axis) {
        const double lo = std::floor((a - reach) / cell[axis] + at[axis]),
                     hi = std::floor((a + reach) / cell[axis] + at[axis]);
        const double other = std::floor(b / cell[axis] + at[axis]);
        return lo <= other && other <= hi;
      };
      for (std::size_t a = 0; a < x.size(); ++a)
        for (std::size_t b = a + 1; b < x.size(); ++b, ++all)
          meet += near(x[a], x[b], 0) && near(y[a], y[b], 1) && near(z[a], z[b], 2);
    }
    return static_cast<double>(meet) / static_cast<double>(all);
  }

  std::vector<float> x, y, z;
  collide::Bodies bodies;
};

TEST(PairSample, PredictsWhatMeetsInAGrid) {
  for (const collide::Index vertices : {100u, 200u}) {
    const Cloud cloud(vertices);
    compare::PairSample sample;
    sample.draw(cloud.view(), true);
    for (const glm::dvec3 cell : {glm::dvec3(0.4), glm::dvec3(1, 0.3, 0.5), glm::dvec3(5)}) {
      for (const double reach : {0.0, 0.1}) {
        const double expected = cloud.meeting(cell, reach);
        EXPECT_NEAR(sample.share(cell, glm::dvec3(reach)), expected, 0.15 * expected) << vertices << ", " << reach;
      }
    }
  }
}

TEST(PairSample, CountsPairsOfBodiesAsTheSettingsSay) {
  const Cloud cloud(120, 4);
  compare::PairSample sample;
  const auto share = [&](bool self_collision) {
    sample.draw(cloud.view(), self_collision);
    return sample.share(glm::dvec3(1e6), glm::dvec3(1e6));
  };
  EXPECT_DOUBLE_EQ(share(true), 1);
  EXPECT_DOUBLE_EQ(share(false), 1 - 4 * (30 * 29) / (120.0 * 119));
}

TEST(PairSample, LeavesOutWhatIsNotFinite) {
  Cloud cloud(100);
  for (float& x : cloud.x) x = NAN;
  compare::PairSample sample;
  sample.draw(cloud.view(), true);
  EXPECT_EQ(sample.share(glm::dvec3(1), glm::dvec3(1)), 0);
  sample.draw(Cloud(0).view(), true);
  EXPECT_EQ(sample.share(glm::dvec3(1), glm::dvec3(1)), 0);
}

}  // namespace THIS_FILE
}  // namespace app
