// Large bodies: the loop over two patches on every target, and the exact method on bodies that it searches by patches,
// against plain loops.

#include "collide/exact/patch_search.h"

#include <cmath>

#include "collide/exact/self_collision_culling.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

class PatchKernels : public OnEveryTarget {};

/// Two runs of slots, in one place or not, each of any size: with and without a rest shape, with and without edges.
TEST_P(PatchKernels, FindWhatPlainLoopsFind) {
  constexpr float tolerance2 = 0.25f;
  for (const Index size_a : {1u, 3u, 8u, 15u, 16u}) {
    for (const Index size_b : {0u, 1u, 5u, 16u}) {  // 0: the pairs of a with itself
      for (const float side : {0.4f, 1.0f, 3.0f}) {
        const Index size = size_a + size_b;
        std::vector<std::array<Index, 2>> edges;
        for (Index k = 0; k < size; ++k)
          edges.push_back({static_cast<Index>(random_() % size), static_cast<Index>(random_() % size)});
        std::vector<glm::vec3> rest = random_points(random_, size, 0, side);
        rest[random_() % size].y = nan;
        State state;
        state.add(std::make_shared<const Shape>(size, edges, rest), random_points(random_, size, 0, side));
        const Shape& shape = *state.bodies.shape[0];

        Points points;
        points.resize(size);
        Patches patches;
        patches.now = &points;
        patches.first_joined = {0};
        patches.first_slot = {0, size_a, size};
        const Range a{0, size_a}, b = size_b == 0 ? a : Range{size_a, size};
        for (Index slot = 0; slot < size + Points::padding; ++slot) {
          const Index vertex = size - 1 - std::min(slot, size - 1);  // in another order
          if (slot < size) points.set(slot, state.frame(), vertex, 0);
          patches.rest_x.push_back(rest[vertex].x);
          patches.rest_y.push_back(rest[vertex].y);
          patches.rest_z.push_back(rest[vertex].z);
        }
        for (Index slot = 0; slot < size; ++slot) {
          for (Index other = 0; other < size; ++other) {
            if (shape.topology().joined(points.vertex[slot], points.vertex[other])) patches.joined.push_back(other);
          }
          patches.first_joined.push_back(static_cast<Index>(patches.joined.size()));
        }
        const std::array patch_slots{a, Range{size_a, size}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto& now = axis == 0 ? points.x : axis == 1 ? points.y : points.z;
          const auto& at_rest = axis == 0 ? patches.rest_x : axis == 1 ? patches.rest_y : patches.rest_z;
          for (auto* lo : {&patches.lo, &patches.rest_lo}) (*lo)[axis].assign(2 + max_lanes, infinity);
          for (auto* hi : {&patches.hi, &patches.rest_hi}) (*hi)[axis].assign(2 + max_lanes, -infinity);
          for (std::size_t patch = 0; patch < 2; ++patch) {
            for (Index slot = patch_slots[patch].begin; slot < patch_slots[patch].end; ++slot) {
              const float lo = std::isnan(at_rest[slot]) ? -infinity : at_rest[slot];
              const float hi = std::isnan(at_rest[slot]) ? infinity : at_rest[slot];
              patches.lo[axis][patch] = std::min(patches.lo[axis][patch], now[slot]);
              patches.hi[axis][patch] = std::max(patches.hi[axis][patch], now[slot]);
              patches.rest_lo[axis][patch] = std::min(patches.rest_lo[axis][patch], lo);
              patches.rest_hi[axis][patch] = std::max(patches.rest_hi[axis][patch], hi);
            }
          }
        }

        std::vector<Contact> within, between;
        for (Index i = a.begin; i < a.end; ++i) {
          for (Index j = size_b == 0 ? i + 1 : b.begin; j < b.end; ++j) {
            if (!(squared_distance(points.x[i], points.y[i], points.z[i], points.x[j], points.y[j], points.z[j]) <
                  tolerance2))
              continue;
            const auto [first, second] = std::minmax(points.vertex[i], points.vertex[j]);
            between.push_back({first, second});
            if (!shape.excludes(first, second, tolerance2)) within.push_back({first, second});
          }
        }
        const Range others = size_b == 0 ? Range{0, 1} : Range{1, 2};
        std::vector<Contact> found(std::size_t{size_a} * b.size() + 1);
        found.resize(patch_contacts_within(patches, 0, others, tolerance2, found.data()).contacts);
        EXPECT_EQ(found, within) << size_a << ' ' << size_b << ' ' << side;
        if (size_b == 0) continue;
        found.resize(std::size_t{size_a} * b.size() + 1);
        found.resize(patch_contacts_between(patches, 0, others, tolerance2, found.data()).contacts);
        EXPECT_EQ(found, between) << size_a << ' ' << size_b << ' ' << side;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, PatchKernels, testing::ValuesIn(targets()), target_name);

/// Large and small bodies in each other, in turn. Most large ones have a rest shape with pairs that are closer than the
/// tolerance, and are folded on themselves; some have edges that are longer than it.
struct MixedBodies {
  const Ball small = icosphere(2, 0.2f), large = icosphere(4, 0.5f);
  const Index count = static_cast<Index>(large.vertices.size());
  const std::shared_ptr<const Shape> small_shape = std::make_shared<const Shape>(162, small.edges, small.vertices);
  std::array<std::shared_ptr<const Shape>, 3> shapes;

  MixedBodies() {
    std::vector<std::array<Index, 2>> edges = large.edges;
    for (Index v = 0; v < count; v += 5) edges.push_back({v, (v * 13 + 200) % count});
    shapes = {std::make_shared<const Shape>(count, large.edges, large.vertices),
              std::make_shared<const Shape>(count, edges, large.vertices),
              std::make_shared<const Shape>(count, large.edges)};
  }
  State at(float phase) const;
};
State MixedBodies::at(float phase) const {
  State state;
  state.tolerance = 0.1f;
  EXPECT_GT(count, CullingReference::max_vertices);
  for (int body = 0; body < 5; ++body) {
    const auto k = static_cast<float>(body);
    state.add(small_shape, moved(small.vertices, glm::vec3(0.5f * k + 0.1f * phase, 0.05f * k, 0)));
    if (body == 2) state.add({});
    if (body > 2) continue;
    std::vector<glm::vec3> folded = large.vertices;
    for (glm::vec3& p : folded) {
      p = glm::vec3(p.x + 0.9f * k, p.y * (0.12f + 0.1f * phase) + 0.1f * std::sin(5 * p.x + phase), p.z);
    }
    state.add(shapes[static_cast<std::size_t>(body)], folded);
  }
  return state;
}

class PatchSearches : public OnEveryTarget {};

TEST_P(PatchSearches, FindWhatTheOracleFinds) {
  const MixedBodies bodies;
  std::vector<State> frames;
  for (const float phase : {0.0f, 0.3f, 0.6f}) frames.push_back(bodies.at(phase));
  for (int rest = 0; rest < 3; ++rest) frames.push_back(State(frames.back()));
  frames.back().x[frames.back().bodies.first[1] + 7] = nan;
  Settings settings;
  settings.tolerance = frames.front().tolerance;
  for (const bool self : {true, false}) {
    settings.self_collision = self;
    const std::array threads{1, 2, 3, 7};
    std::array<std::unique_ptr<Detector>, threads.size()> detectors;
    for (auto& detector : detectors) detector = find_method("multi-level-sb-exact")->make();
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      const std::vector<Contact> expected = oracle(frames[frame], settings);
      const std::size_t inside = inside_bodies(frames[frame], expected).size();
      ASSERT_GT(expected.size(), 1'000u);
      for (std::size_t k = 0; k < threads.size(); ++k) {
        Workers workers(threads[k], 0);
        Result result;
        detectors[k]->detect(frames[frame].frame(), settings, workers, result);
        EXPECT_TRUE(result.contacts == expected) << self << ' ' << threads[k] << ' ' << frame;
        EXPECT_EQ(result.self_contacts, inside);
        EXPECT_EQ(result.skip(Skip::kept_pairs) > 0, frame >= 4) << frame;
      }
    }
  }
}

/// One target of each width suffices here.
INSTANTIATE_TEST_SUITE_P(Targets, PatchSearches, testing::Values(targets().front(), targets().back()), target_name);

/// Its patches hold vertices that lie anywhere in it after a frame in which they change places.
TEST(PatchSearch, CutsABodyAnewWhoseVerticesHaveMixed) {
  std::mt19937 random(77);
  std::vector<glm::vec3> points = random_points(random, 4'000, 0, 1);
  State before, after;
  before.add(points);
  std::shuffle(points.begin(), points.end(), random);
  after.add(before.bodies.shape[0], points);
  Settings settings;
  settings.tolerance = 0.02f;
  Workers workers(2, 0);
  const auto detector = find_method("multi-level-sb-exact")->make();
  Result result;
  detector->detect(before.frame(), settings, workers, result);
  const std::uint64_t tests = result.counters.pair_tests;
  detector->detect(after.frame(), settings, workers, result);
  EXPECT_EQ(result.contacts, oracle(after, settings));
  EXPECT_LT(result.counters.pair_tests, 2 * tests);
}

/// Two bodies of a mesh whose vertices are all closer than the tolerance to many others at rest.
class WideTolerance : public testing::Test {
 protected:
  /// Detects so many bodies that overlap, and expects what the oracle finds.
  Result find(const std::shared_ptr<const Shape>& shape, float tolerance, int bodies = 1) {
    State state;
    for (int body = 0; body < bodies; ++body) {
      state.add(shape, moved(ball_.vertices, glm::vec3(0.05f * static_cast<float>(body), 0, 0)));
    }
    Settings settings;
    settings.tolerance = tolerance;
    Result result = detect("multi-level-sb-exact", state, settings, 2);
    EXPECT_TRUE(result.contacts == oracle(state, settings));
    return result;
  }

  const Ball ball_ = icosphere(4, 0.5f);
  const Index count_ = static_cast<Index>(ball_.vertices.size());
  const std::shared_ptr<const Shape> shape_ = std::make_shared<const Shape>(count_, ball_.edges, ball_.vertices);
};

TEST_F(WideTolerance, LeavesOutPatchesThatAreCloseAtRest) {
  const Result result = find(shape_, 0.9f);
  EXPECT_TRUE(result.contacts.empty());
  const Result without_rest = find(std::make_shared<const Shape>(count_, ball_.edges), 0.9f);
  EXPECT_LT(result.counters.pair_tests, without_rest.counters.pair_tests / 2);
}

TEST_F(WideTolerance, LeavesOutNoPatchesOfTwoBodies) { EXPECT_GT(find(shape_, 0.75f, 2).contacts.size(), 1'000'000u); }

TEST_F(WideTolerance, LeavesOutNoVertexWithoutAPlaceAtRest) {
  std::vector<glm::vec3> rest = ball_.vertices;
  rest[7].y = nan;
  EXPECT_GT(find(std::make_shared<const Shape>(count_, ball_.edges, rest), 0.9f).contacts.size(), 1'000u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
