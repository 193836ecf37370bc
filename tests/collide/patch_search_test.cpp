// The exact method on large bodies, which it searches by patches, against plain loops.

#include "collide/exact/patch_search.h"

#include <cmath>

#include "collide/exact/self_collision_culling.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

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

TEST(PatchSearch, FindsWhatTheOracleFindsOnEveryTargetAndNumberOfThreads) {
  const MixedBodies bodies;
  std::vector<State> frames;
  for (const float phase : {0.0f, 0.3f, 0.6f}) frames.push_back(bodies.at(phase));
  for (int rest = 0; rest < 3; ++rest) frames.push_back(State(frames.back()));
  frames.back().x[frames.back().bodies.first[1] + 7] = nan;
  std::array<Workers, 3> workers{Workers(1), Workers(3, 0), Workers(7, 0)};
  Settings settings{.tolerance = frames.front().tolerance};
  for (const bool self : {true, false}) {
    settings.self_collision = self;
    std::vector<std::vector<Contact>> expected;
    for (const State& frame : frames) expected.push_back(oracle(frame, settings));
    for (const std::int64_t target : targets()) {
      const tests::UseTarget use(target);
      for (Workers& some : workers) {
        const auto detector = find_method("multi-level-sb-exact")->make();
        for (std::size_t k = 0; k < frames.size(); ++k) {
          SCOPED_TRACE(testing::Message()
                       << hwy::TargetName(target) << ' ' << some.threads() << " threads, frame " << k);
          Result result;
          detector->detect(frames[k].frame(), settings, some, result);
          EXPECT_TRUE(result.contacts == expected[k]);
          EXPECT_EQ(result.self_contacts, inside_bodies(frames[k], expected[k]).size());
          EXPECT_EQ(result.skip(Skip::kept_pairs) > 0, k >= 4);
        }
      }
    }
    for (const auto& contacts : expected) EXPECT_GT(contacts.size(), 1'000u);
  }
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
    const Settings settings{.tolerance = tolerance};
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

/// A sheet of side x side vertices, 0.1 m apart, with edges along and across.
struct Sheet {
  static constexpr float edge = 0.1f;
  int side;
  std::vector<glm::vec3> rest;
  std::vector<std::array<Index, 2>> edges;

  explicit Sheet(int count) : side(count) {
    for (int i = 0; i < side * side; ++i) {
      const int column = i % side, row = i / side;
      rest.push_back(edge * glm::vec3(column, row, 0));
      const auto join = [&](int other) { edges.push_back({static_cast<Index>(i), static_cast<Index>(other)}); };
      if (column > 0) join(i - 1);
      if (row > 0) join(i - side);
      if (column > 0 && row > 0) join(i - side - 1);
    }
  }
  std::shared_ptr<const Shape> shape(bool with_rest) const {
    return std::make_shared<const Shape>(static_cast<Index>(rest.size()), edges,
                                         with_rest ? rest : std::vector<glm::vec3>{});
  }
  /// The sheet as it waves, then folded on itself, then crumpled, then in no order at all.
  std::vector<glm::vec3> at(int frame, const glm::vec3& origin) const {
    std::mt19937 random(static_cast<std::uint32_t>(side + frame));
    std::vector<glm::vec3> points = rest;
    const float middle = 0.5f * edge * static_cast<float>(side), phase = 0.4f * static_cast<float>(frame);
    for (glm::vec3& p : points) {
      p.z = 2 * edge * std::sin(3 * p.x + phase) * std::cos(2 * p.y);
      if (frame >= 2 && p.x > middle) p = glm::vec3(2 * middle - p.x, p.y, p.z + 0.3f * edge);
      if (frame >= 3) p = glm::vec3(p.x, 0.2f * std::sin(4 * p.y), p.z) + random_points(random, 1, -edge, edge)[0];
      if (frame >= 4) p = random_points(random, 1, 0, 3 * middle)[0];
    }
    return moved(points, origin);
  }
};

/// One detector takes all frames, so that what it keeps from earlier ones is put to the test, too.
void expect_what_the_oracle_finds(const std::vector<State>& frames, const Settings& settings) {
  std::vector<std::vector<Contact>> expected;
  for (const State& frame : frames) expected.push_back(oracle(frame, settings));
  Workers one(1), two(2, 0);
  for (const std::int64_t target : targets()) {
    const tests::UseTarget use(target);
    for (Workers* workers : {&one, &two}) {
      const auto detector = find_method("multi-level-sb-exact")->make();
      for (std::size_t k = 0; k < frames.size(); ++k) {
        Result result;
        detector->detect(frames[k].frame(), settings, *workers, result);
        EXPECT_TRUE(result.contacts == expected[k])
            << hwy::TargetName(target) << ", " << workers->threads() << " threads, frame " << k << ": "
            << result.contacts.size() << " contacts of " << expected[k].size();
        EXPECT_EQ(result.self_contacts, inside_bodies(frames[k], expected[k]).size());
      }
    }
  }
}

constexpr int sheet_frames = 6;

TEST(PatchSearch, FindsWhatTheOracleFindsOnASurface) {
  for (const int side : {1, 4, 5, 16, 21}) {
    const Sheet sheet(side);
    for (const float tolerance : {1e-3f, 0.25f, 0.5f, 1.0f, 2.0f}) {
      for (const bool with_rest : {true, false}) {
        for (const float far : {0.0f, -3e3f, 7e7f}) {
          SCOPED_TRACE(testing::Message() << side << " a side, tolerance " << tolerance << ", at " << far);
          const auto shape = sheet.shape(with_rest);
          std::vector<State> frames(sheet_frames);
          for (int k = 0; k < sheet_frames; ++k)
            frames[static_cast<std::size_t>(k)].add(shape, sheet.at(k, glm::vec3(far, 0, far)));
          expect_what_the_oracle_finds(frames, {.tolerance = tolerance * Sheet::edge});
        }
      }
    }
  }
}

/// Of two sheets that lie on each other, all vertices face the other one.
TEST(PatchSearch, CostsNoSquareOfTheVerticesOfTwoBodies) {
  std::uint64_t before = 0;
  for (const int side : {32, 64, 128}) {
    const Sheet sheet(side);
    State state;
    for (const float height : {0.0f, 0.3f * Sheet::edge})
      state.add(sheet.shape(true), moved(sheet.rest, glm::vec3(0, 0, height)));
    const Result result =
        detect("multi-level-sb-exact", state, {.tolerance = 0.5f * Sheet::edge, .self_collision = false});
    EXPECT_EQ(result.contacts.size(), sheet.rest.size());
    const std::uint64_t tests = result.counters.pair_tests;
    EXPECT_TRUE(before == 0 || tests < 6 * before) << side << ": " << tests;
    before = tests;
  }
}

TEST(PatchSearch, FindsWhatTheOracleFindsOnSurfacesAmongSpheres) {
  const Sheet large(48), small(20);
  const Ball ball = icosphere(2, 0.5f);
  const auto sphere = std::make_shared<const Shape>(Index{162}, ball.edges, ball.vertices);
  for (const float tolerance : {0.25f, 1.5f}) {
    for (const bool with_rest : {true, false}) {
      SCOPED_TRACE(testing::Message() << "tolerance " << tolerance << (with_rest ? ", rest known" : ""));
      const std::array shapes{large.shape(with_rest), small.shape(with_rest)};
      std::vector<State> frames(sheet_frames);
      for (int k = 0; k < sheet_frames; ++k) {
        State& state = frames[static_cast<std::size_t>(k)];
        for (int copy = 0; copy < 2; ++copy) {
          const glm::vec3 at = 0.07f * static_cast<float>(copy) * glm::vec3(1, 1, 0.3f);
          state.add(shapes[0], large.at(k, at));
          state.add(sphere, moved(ball.vertices, at + glm::vec3(1, 1, 0.1f * static_cast<float>(k))));
          state.add(shapes[1], small.at(k, at));
        }
      }
      expect_what_the_oracle_finds(frames, {.tolerance = tolerance * Sheet::edge});
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
