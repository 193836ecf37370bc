// Compares closest points with the smallest distance over corners, sides and insides, computed in double.

#include "collide/surface/closest_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "every_target.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

using glm::dvec3;

double distance_of_edges(const dvec3& p, const dvec3& q, const dvec3& r, const dvec3& s) {
  const double ends = std::min({distance_to_segment(p, r, s), distance_to_segment(q, r, s),
                                distance_to_segment(r, p, q), distance_to_segment(s, p, q)});
  const dvec3 n = glm::cross(q - p, s - r);
  const double n2 = glm::dot(n, n);
  if (n2 == 0) return ends;
  const double along = glm::dot(glm::cross(r - p, s - r), n) / n2, across = glm::dot(glm::cross(r - p, q - p), n) / n2;
  const bool inner = along > 0 && along < 1 && across > 0 && across < 1;
  return inner ? std::min(ends, std::abs(glm::dot(r - p, n)) / std::sqrt(n2)) : ends;
}

struct Features {
  glm::vec3 p, q, r, s;  // vertex p against face qrs, or edge pq against edge rs
};

constexpr double close = 2e-5;         // m, of coordinates up to 1 m
constexpr double sliver_error = 4e-3;  // m: 1e-3 of the length of the longest

/// Expects valid weights, a separation that joins the weighted points, and the smallest possible distance.
void expect_closest_vertex_face(const Features& f, const char* what, double error = close) {
  const Closest c = closest_vertex_face(f.p, f.q, f.r, f.s);
  EXPECT_EQ(c.weight[0], 1);
  for (int k = 1; k < 4; ++k) EXPECT_GE(c.weight[k], -1e-6f) << what;
  EXPECT_NEAR(c.weight[1] + c.weight[2] + c.weight[3], 1, 1e-6) << what;
  const dvec3 point =
      double(c.weight[1]) * dvec3(f.q) + double(c.weight[2]) * dvec3(f.r) + double(c.weight[3]) * dvec3(f.s);
  EXPECT_LT(glm::length(dvec3(f.p) - point - dvec3(c.separation)), 2e-6) << what;
  EXPECT_NEAR(glm::length(c.separation), distance_to_face(dvec3(f.p), dvec3(f.q), dvec3(f.r), dvec3(f.s)), error)
      << what;
}

void expect_closest_edges(const Features& f, const char* what, double error = close) {
  const Closest c = closest_edges(f.p, f.q, f.r, f.s);
  for (const float weight : c.weight) EXPECT_TRUE(weight >= 0 && weight <= 1) << what << ' ' << weight;
  EXPECT_NEAR(c.weight[0] + c.weight[1], 1, 1e-6) << what;
  EXPECT_NEAR(c.weight[2] + c.weight[3], 1, 1e-6) << what;
  const dvec3 one = double(c.weight[0]) * dvec3(f.p) + double(c.weight[1]) * dvec3(f.q),
              two = double(c.weight[2]) * dvec3(f.r) + double(c.weight[3]) * dvec3(f.s);
  EXPECT_LT(glm::length(one - two - dvec3(c.separation)), 2e-6) << what;
  EXPECT_NEAR(glm::length(c.separation), distance_of_edges(dvec3(f.p), dvec3(f.q), dvec3(f.r), dvec3(f.s)), error)
      << what;
}

/// Returns features within a cube of 2 m. The last two corners are moved towards the second: `shape` is the share of
/// their distance that is left.
std::vector<Features> random_features(std::mt19937& random, std::size_t count, float shape) {
  std::vector<Features> list;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<glm::vec3> c = random_points(random, 4, -1, 1);
    list.push_back({c[0], c[1], glm::mix(c[1], c[2], shape), glm::mix(c[1], c[3], shape)});
  }
  return list;
}

TEST(ClosestFeatures, AreClosestForRandomFeatures) {
  std::mt19937 random(51);
  int inner_faces = 0, inner_edges = 0;
  for (const float shape : {1.0f, 0.3f, 0.01f})
    for (const Features& f : random_features(random, 3000, shape)) {
      expect_closest_vertex_face(f, "vertex and face");
      expect_closest_edges({f.p, f.s, f.q, f.r}, "edges");
      inner_faces += closest_vertex_face(f.p, f.q, f.r, f.s).inner;
      inner_edges += closest_edges(f.p, f.s, f.q, f.r).inner;
    }
  EXPECT_GT(inner_faces, 100);
  EXPECT_GT(inner_edges, 100);
}

TEST(ClosestFeatures, InnerIsTrueIfBothPointsLieInside) {
  const glm::vec3 a(0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_TRUE(closest_vertex_face({0.25f, 0.25f, 1}, a, b, c).inner);
  EXPECT_FALSE(closest_vertex_face({0.25f, -0.25f, 1}, a, b, c).inner);
  EXPECT_FALSE(closest_vertex_face({-1, -1, 1}, a, b, c).inner);
  for (const glm::vec3& on_side : {0.5f * (a + b), 0.5f * (b + c), 0.5f * (c + a)})
    EXPECT_FALSE(closest_vertex_face(on_side + glm::vec3(0, 0, 1), a, b, c).inner) << on_side.x << ' ' << on_side.y;
  EXPECT_TRUE(closest_edges({-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}).inner);
  EXPECT_FALSE(closest_edges({-1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 2}).inner)
      << "one edge ends above the middle of the other";
  EXPECT_FALSE(closest_edges({-1, 0, 0}, {1, 0, 0}, {2, -1, 1}, {2, 1, 1}).inner);
}

/// Slivers, and faces that are a line or a point: exactly, on a lattice, and but for rounding.
TEST(ClosestFeatures, AreClosestForDegenerateFaces) {
  std::mt19937 random(52);
  for (int i = 0; i < 3000; ++i) {
    const std::vector<glm::vec3> c = random_points(random, 3, -1, 1);
    const float t = uniform(random, -0.5f, 1.5f);
    const glm::vec3 lattice = glm::round(4.0f * c[1]) / 4.0f, step = glm::round(2.0f * c[2]) / 8.0f;
    expect_closest_vertex_face({c[0], c[1], c[1], c[1]}, "a point");
    expect_closest_vertex_face({c[0], c[1], c[1], c[2]}, "two corners in one place");
    expect_closest_vertex_face({c[0], c[1], c[2], c[1]}, "two others");
    expect_closest_vertex_face({c[0], c[2], c[1], c[1]}, "the last two");
    expect_closest_vertex_face({c[0], lattice, lattice + step, lattice + 3.0f * step}, "a line on the lattice");
    expect_closest_vertex_face({c[0], lattice + step, lattice, lattice + 3.0f * step}, "a line, its middle first");
    expect_closest_vertex_face({c[0], c[1], c[2], glm::mix(c[1], c[2], t)}, "a line but for rounding");
    expect_closest_vertex_face({c[0], c[1], c[1] + 1e-4f * c[0], c[2]}, "a needle");
    expect_closest_vertex_face({c[0], c[1], c[2], glm::mix(c[1], c[2], t) + 5e-4f * c[0]}, "a sliver", sliver_error);
  }
}

TEST(ClosestFeatures, AreClosestForDegenerateAndParallelEdges) {
  std::mt19937 random(53);
  for (int i = 0; i < 3000; ++i) {
    const std::vector<glm::vec3> c = random_points(random, 4, -1, 1);
    const float t = uniform(random, -1.5f, 1.5f);
    expect_closest_edges({c[0], c[0], c[1], c[2]}, "the first a point");
    expect_closest_edges({c[0], c[1], c[2], c[2]}, "the second a point");
    expect_closest_edges({c[0], c[0], c[1], c[1]}, "two points");
    expect_closest_edges({c[0], c[1], c[0], c[1]}, "the same");
    expect_closest_edges({c[0], c[1], c[2], c[2] + t * (c[1] - c[0])}, "parallel");
    expect_closest_edges({c[0], c[1], c[0] + t * (c[1] - c[0]), c[1] + t * (c[1] - c[0])}, "on one line");
    expect_closest_edges({c[0], c[1], c[2], c[2] + t * (c[1] - c[0]) + 1e-4f * c[3]}, "almost parallel", sliver_error);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
