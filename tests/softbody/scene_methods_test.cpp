// Every method with all kinds of settings on moments of every scene that the program ships, against brute force.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

using collide::Contact;

/// Positions of a world at one moment, which outlive it.
struct Moment {
  explicit Moment(const World& world) : bodies(world.bodies()) {
    const collide::Frame now = world.positions();
    x.assign(now.x.begin(), now.x.end());
    y.assign(now.y.begin(), now.y.end());
    z.assign(now.z.begin(), now.z.end());
  }
  collide::Frame frame() const { return {x, y, z, &bodies}; }

  std::vector<float> x, y, z;
  collide::Bodies bodies;
};

/// The scene's tolerance with every level, bucket count and cell size that the method has use for.
std::vector<collide::Settings> all_settings(const World& world, const collide::Method& method) {
  std::vector<collide::Settings> all;
  collide::Settings s = world.scene().collision;
  for (const int level : method.uses_levels ? std::vector{0, 3, 6, 9} : std::vector{3}) {
    s.levels = level;
    const glm::vec3 automatic = world.automatic_cell_size(level);
    for (const std::uint32_t buckets : method.uses_hash ? std::vector{101u, 1001u, 65537u} : std::vector{1001u}) {
      s.buckets = buckets;
      for (const glm::vec3 cell : {automatic, 0.4f * automatic, glm::vec3(0.23f, 1.1f, 0.5f)}) {
        s.cell_size = cell;
        all.push_back(s);
        if (!method.uses_hash) break;
      }
    }
  }
  return all;
}

std::string describe(const collide::Method& method, const collide::Settings& s) {
  return std::string(method.key) + ", levels " + std::to_string(s.levels) + ", buckets " + std::to_string(s.buckets) +
         ", cell " + std::to_string(s.cell_size->x) + (s.self_collision ? "" : ", no self-collision");
}

/// How many of the true contacts the literal method found where no box exceeds a cell.
struct Recall {
  std::size_t found = 0, all = 0;
};

/// Detectors that see all moments one after another: whatever they keep would show.
class Bench {
 public:
  Bench() {
    for (const collide::Method& method : collide::method_table()) detectors_.push_back(method.make());
  }
  const collide::Result& detect(const collide::Method& method, const Moment& moment,
                                const collide::Settings& settings) {
    const auto index = static_cast<std::size_t>(&method - collide::method_table().data());
    detectors_[index]->detect(moment.frame(), settings, workers_, result_);
    return result_;
  }
  /// Exact: the true contacts. Literal: some of them.
  void expect(const collide::Method& method, const Moment& moment, const collide::Settings& settings,
              const std::vector<Contact>& truth, Recall& recall) {
    const collide::Result& r = detect(method, moment, settings);
    if (method.exact) {
      ASSERT_TRUE(r.contacts == truth) << describe(method, settings) << ": " << r.contacts.size() << " instead of "
                                       << truth.size();
      return;
    }
    ASSERT_TRUE(std::ranges::includes(truth, r.contacts)) << describe(method, settings);
    if (r.coverage != collide::Coverage::covered) return;
    recall.found += r.contacts.size();
    recall.all += truth.size();
  }

 private:
  std::vector<std::unique_ptr<collide::Detector>> detectors_;
  collide::Workers workers_{2, 0};
  collide::Result result_;
};

struct Moments {
  const char* scene;
  std::vector<int> frames;  // bodies, or folds of the cloth, touch
  bool covered = true;      // with some of the settings every box of the literal method fits a cell
};

// The cloth is flat at rest, so that its automatic cells are too flat for it as soon as it hangs.
const Moments moments[]{{"A", {35, 40, 45}},     {"B", {52, 140, 200}},           {"C", {52, 130, 300}},
                        {"D", {52, 130, 300}},   {"cloth", {53, 80, 400}, false}, {"drop", {421, 540, 610}},
                        {"star", {40, 80, 200}}, {"container", {40, 100, 300}},   {"trampoline", {60, 200}},
                        {"wring", {150}, false}};

class SceneMethods : public testing::TestWithParam<Moments> {};

TEST_P(SceneMethods, FindWhatBruteForceFindsOrSayThatTheyMayMissSome) {
  const Scene scene = find_scene(GetParam().scene, SBCOLLIDE_SCENES);
  World world(scene, {.threads = 2});
  Bench bench;
  Recall recall;
  for (const int frame : GetParam().frames) {
    run(world, frame - world.frame());
    const Moment moment(world);
    for (const bool self : {true, false}) {
      collide::Settings settings = scene.collision;
      settings.self_collision = self;
      const std::vector<Contact> truth =
          bench.detect(*collide::find_method(collide::reference_method), moment, settings).contacts;
      ASSERT_GE(truth.size(), self ? 10u : 0u) << "frame " << frame;
      for (const collide::Method& method : collide::method_table()) {
        // What an exact method makes of its settings does not depend on self-collision: the first ones are enough.
        const std::vector<collide::Settings> all = all_settings(world, method);
        for (collide::Settings tried : std::span(all).first(self || !method.exact ? all.size() : 1)) {
          tried.self_collision = self;
          ASSERT_NO_FATAL_FAILURE(bench.expect(method, moment, tried, truth, recall)) << "frame " << frame;
        }
      }
    }
  }
  ASSERT_EQ(recall.all > 500, GetParam().covered) << recall.all;
  // Contacts across a cell's face are lost: .972 (B) to .991 (C) of all were found.
  EXPECT_GE(static_cast<double>(recall.found), 0.95 * static_cast<double>(recall.all));
}

INSTANTIATE_TEST_SUITE_P(All, SceneMethods, testing::ValuesIn(moments),
                         [](const auto& i) { return std::string(i.param.scene); });

/// A scene of so many vertices that brute force would take minutes.
struct LargeMoment {
  const char* scene;
  int frame;
  double found;  // by the literal method, of what there is
};
const LargeMoment large_moments[]{{"drop-3000", 20, 0.8},  // in a lattice whose bodies hardly touch yet
                                  {"shapes", 60, 0.8}};

class LargeSceneMethods : public testing::TestWithParam<LargeMoment> {};

/// The exact methods are compared with one another.
TEST_P(LargeSceneMethods, ExactOnesAgreeAndTheLiteralOneFindsAPart) {
  World world(find_scene(GetParam().scene, SBCOLLIDE_SCENES), {.threads = 2});
  run(world, GetParam().frame);
  const Moment moment(world);
  Bench bench;
  Recall recall;
  const std::vector<Contact> truth =
      bench.detect(*collide::find_method("bounding-box"), moment, world.collision()).contacts;
  ASSERT_GT(truth.size(), 1000u);
  for (const collide::Method& method : collide::method_table()) {
    if (method.key == collide::reference_method) continue;
    for (const int level : method.uses_levels ? std::vector{3, 6} : std::vector{3}) {
      collide::Settings settings = world.collision();
      settings.levels = level;
      ASSERT_NO_FATAL_FAILURE(bench.expect(method, moment, settings, truth, recall));
    }
  }
  EXPECT_GT(static_cast<double>(recall.found), GetParam().found * static_cast<double>(recall.all));
}

INSTANTIATE_TEST_SUITE_P(All, LargeSceneMethods, testing::ValuesIn(large_moments), [](const auto& i) {
  std::string name = i.param.scene;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(SceneMethodsTable, NamesEveryScene) {
  std::vector<std::string> tried;
  for (const Moments& m : moments) tried.emplace_back(m.scene);
  for (const LargeMoment& m : large_moments) tried.emplace_back(m.scene);
  std::ranges::sort(tried);
  EXPECT_EQ(tried, scene_keys(SBCOLLIDE_SCENES));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
