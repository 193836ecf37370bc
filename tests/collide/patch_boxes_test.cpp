// Compares the pairs of overlapping boxes with those of plain loops, on every target.

#include "collide/surface/patch_boxes.h"

#include <algorithm>
#include <random>

#include "collide/core/aabb.h"
#include "collide/surface/pair_sort.h"
#include "every_target.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

using Boxes = std::vector<Aabb>;
constexpr std::size_t unlimited = ~std::size_t{0};

/// A list of boxes, whose places have another order than their numbers. Each is grown by its room.
struct List {
  Boxes grown;
  FeaturePatches features;
  PatchBoxes boxes;

  List(const Boxes& of, std::mt19937& random) {
    PatchBoxes::Columns lo, hi;
    std::vector<float> room;
    for (Index k = 0; k < of.size(); ++k) {
      features.feature.push_back(k);
      room.push_back(static_cast<float>(random() % 3) / 8);
      grown.push_back({of[k].lo - room[k], of[k].hi + room[k]});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis].push_back(of[k].lo[static_cast<int>(axis)]);
        hi[axis].push_back(of[k].hi[static_cast<int>(axis)]);
      }
    }
    std::ranges::shuffle(features.feature, random);
    for (const Index k : features.feature) features.corners.push_back({k, k, k});
    boxes.fill(features, lo, hi, room);
  }
  List(const List&) = delete;
};

bool overlap(const Aabb& a, const Aabb& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return false;
  return true;
}

Boxes random_boxes(std::mt19937& random, std::size_t count, float space, float side) {
  Boxes boxes;
  for (const glm::vec3& lo : random_points(random, count, 0, space))
    boxes.push_back({lo, lo + random_points(random, 1, 0, side)[0]});
  return boxes;
}

/// Returns boxes with corners on a lattice: many boxes touch, and cuts pass through corners.
Boxes lattice_boxes(std::mt19937& random, std::size_t count, unsigned space) {
  Boxes boxes;
  const auto step = [&](unsigned n) { return static_cast<float>(random() % n); };
  for (std::size_t k = 0; k < count; ++k) {
    const glm::vec3 lo{step(space), step(space), step(space)};
    boxes.push_back({lo, lo + glm::vec3{step(3), step(3), step(3)}});
  }
  return boxes;
}

class OverlapSearchTest : public OnEveryTarget {
 protected:
  /// Returns the pairs of two lists, or within one if both are the same.
  std::vector<ItemPair> found(const List& a, const glm::vec3& move_lo, const glm::vec3& move_hi, const List& b) {
    if (&a == &b)
      search_.find_within(a.boxes, b.boxes, {a.features, a.features, a.features.size()}, unlimited);
    else
      search_.find_between(a.boxes, move_lo, move_hi, b.boxes, unlimited);
    std::vector<ItemPair> pairs;
    search_.for_each([&](Index one, Index two) {
      const Index i = a.features.feature[one], j = b.features.feature[two];
      pairs.push_back(&a == &b ? ItemPair{std::min(i, j), std::max(i, j)} : ItemPair{i, j});
    });
    EXPECT_EQ(pairs.size(), search_.size());
    std::ranges::sort(pairs);
    return pairs;
  }
  /// Expects the pairs of plain loops between two lists, of which the first is moved, and within the first one. Returns
  /// how many there are.
  std::size_t expect_plain_pairs(const Boxes& a, const Boxes& b) {
    const List one(a, random_), two(b, random_);
    const glm::vec3 lo = random_points(random_, 1, -0.2f, 0)[0], hi = random_points(random_, 1, 0, 0.2f)[0];
    std::vector<ItemPair> between, within;
    for (Index i = 0; i < a.size(); ++i) {
      const Aabb &box = one.grown[i], moved_box{box.lo + lo, box.hi + hi};
      for (Index j = 0; j < b.size(); ++j)
        if (overlap(moved_box, two.grown[j])) between.push_back({i, j});
      for (Index j = i + 1; j < a.size(); ++j)
        if (overlap(box, one.grown[j])) within.push_back({i, j});
    }
    const glm::vec3 none(0.0f);
    EXPECT_EQ(found(one, lo, hi, two), between);
    EXPECT_EQ(found(one, none, none, one), within);
    return between.size() + within.size();
  }
  OverlapSearch search_;
};

TEST_P(OverlapSearchTest, FindsThePairsOfPlainLoops) {
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 255u, 256u, 257u, 600u}) {
    SCOPED_TRACE(count);
    expect_plain_pairs(random_boxes(random_, count, 2, 0.4f), random_boxes(random_, 70, 2, 0.4f));
  }
}

TEST_P(OverlapSearchTest, FindsEachPairOnceInManyGroups) {
  const std::size_t count = 1100;
  for (const bool lattice : {false, true})
    for (const float space : {3.0f, 30.0f}) {
      const auto make = [&] {
        return lattice ? lattice_boxes(random_, count, static_cast<unsigned>(space) + 5)
                       : random_boxes(random_, count, space, 1);
      };
      EXPECT_GT(expect_plain_pairs(make(), make()), 20u) << lattice << ' ' << space;
    }
}

TEST_P(OverlapSearchTest, FindsAllPairsOfBoxesInOnePlace) {
  const Boxes points(300, Aabb{glm::vec3(0.5f), glm::vec3(0.5f)}), equal(600, Aabb{glm::vec3(-1), glm::vec3(2)});
  EXPECT_EQ(expect_plain_pairs(points, equal), 300u * 600 + 300 * 299 / 2);
}

TEST_P(OverlapSearchTest, FindsThePairsOfTheLargestCoordinates) {
  for (const float scale : {1e30f, 3e38f}) {
    Boxes boxes = random_boxes(random_, 300, 1, 0.2f);
    for (Aabb& box : boxes) box = {scale * (box.lo - 0.5f), scale * (box.hi - 0.5f)};
    EXPECT_GT(expect_plain_pairs(boxes, boxes), 300u) << scale;
  }
}

/// All boxes overlap. The fan has a vertex of many patches of faces, and a body may be smaller than a patch.
TEST_P(OverlapSearchTest, LeavesOutPairsWithinASurfaceThatShareAVertex) {
  SurfaceMesh fan, face{random_points(random_, 3, 0, 1), {{0, 1, 2}}};
  fan.vertices = random_points(random_, 101, 0, 1);
  for (Index v = 1; v < 101; ++v) fan.triangles.push_back({0, v, v % 100 + 1});
  for (const SurfaceMesh& mesh : {ball(1), sheet(7, 1), fan, face}) {
    const Surface surface(static_cast<Index>(mesh.vertices.size()), mesh.triangles);
    const Points3 at(mesh.vertices);
    const SurfacePatches& patches = surface.patches(at.run());
    const SurfaceJoints& joints = surface.joints(at.run());
    const std::vector<float> room(mesh.vertices.size(), 10.0f);
    const auto expect = [&](const FeaturePatches& ones, const FeaturePatches& twos, const JoinedPairs& joined) {
      PatchBoxes a, b;
      a.fill(ones, {at.x, at.y, at.z}, {at.x, at.y, at.z}, room);
      b.fill(twos, {at.x, at.y, at.z}, {at.x, at.y, at.z}, room);
      std::vector<ItemPair> found, expected;
      search_.find_within(a, &ones == &twos ? a : b, joined, unlimited);
      search_.for_each([&](Index i, Index j) { found.push_back({i, j}); });
      for (Index i = 0; i < ones.size(); ++i)
        for (Index j = &ones == &twos ? i + 1 : 0; j < twos.size(); ++j) {
          const auto &c = ones.corners[i], &d = twos.corners[j];
          if (std::ranges::find_first_of(c, d) == c.end()) expected.push_back({i, j});
        }
      std::ranges::sort(found);
      EXPECT_EQ(found, expected);
    };
    expect(patches.vertices, patches.faces, joints.vertex_faces);
    expect(patches.edges, patches.edges, joints.edge_edges);
  }
}

TEST(JoinedPairs, ThrowAtAVertexOfTooManyEdges) {
  std::vector<Triangle> fan;
  for (Index v = 1; v < 12'001; ++v) fan.push_back({0, v, v % 12'000 + 1});
  const Surface surface(12'001, fan);
  const Points3 at(std::vector<glm::vec3>(12'001, glm::vec3(0)));
  EXPECT_THROW(surface.joints(at.run()), std::length_error);
}

TEST_P(OverlapSearchTest, ThrowsAboveMaxPairs) {
  const Boxes boxes(300, Aabb{glm::vec3(0), glm::vec3(1)});
  const List list(boxes, random_), other(boxes, random_);
  const glm::vec3 none(0.0f);
  EXPECT_NO_THROW(search_.find_between(list.boxes, none, none, other.boxes, 300 * 300));
  EXPECT_THROW(search_.find_between(list.boxes, none, none, other.boxes, 300 * 300 - 1), std::length_error);
}

INSTANTIATE_TEST_SUITE_P(Targets, OverlapSearchTest, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
