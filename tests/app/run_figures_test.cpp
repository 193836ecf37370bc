#include "app/compare/run_figures.h"

#include <gtest/gtest.h>

#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

softbody::World world_by(std::string_view method) {
  softbody::Scene scene = touching_pair();
  scene.method = method;
  scene.collision.cell_size = glm::vec3(0.13f);
  scene.collision.buckets = 1'000'003;  // almost no aliasing, which would hide missed contacts
  return softbody::World(scene, {});
}

void count(compare::RunFigures& figures, softbody::World& world, int frames) {
  for (int i = 0; i < frames; ++i) {
    world.step();
    figures.add(world);
  }
}

TEST(RunFigures, SumsTheContactsThatBruteForceFindsAndTheMethodMisses) {
  softbody::World world = world_by("multi-level-sb");
  compare::RunFigures figures;
  std::uint64_t contacts = 0, missed = 0;
  double ms = 0;
  for (int frame = 1; frame <= 10; ++frame) {
    count(figures, world, 1);
    const compare::Score expected = compare::score(world.detection().contacts, true_contacts(world));
    contacts += true_contacts(world).size();
    missed += expected.missed.size();
    ms += world.last_step().detect_ms;
    EXPECT_EQ(figures.missed(), expected.missed) << frame;
  }
  EXPECT_GT(missed, 0u);
  EXPECT_EQ(figures.totals().frame, 10);
  EXPECT_EQ(figures.totals().frames, 10);
  EXPECT_EQ(figures.totals().true_contacts, contacts);
  EXPECT_EQ(figures.totals().missed, missed);
  EXPECT_EQ(figures.totals().detect_ms, ms);
  EXPECT_DOUBLE_EQ(figures.totals().recall(), 1 - double(missed) / double(contacts));
}

TEST(RunFigures, CountsTheContactsOfAMethodThatFindsAllAsTrueOnes) {
  softbody::World world = world_by("grid-hash");
  compare::RunFigures figures;
  count(figures, world, 1);
  EXPECT_GT(world.detection().contacts.size(), 0u);
  EXPECT_EQ(figures.totals().true_contacts, world.detection().contacts.size());
  EXPECT_EQ(figures.totals().missed, 0u);
  EXPECT_TRUE(figures.missed().empty());
}

TEST(RunFigures, KeepsTheLastOverlapsAndTheLargest) {
  softbody::World world = world_by("multi-level-sb");
  compare::RunFigures figures;
  count(figures, world, 1);
  figures.add({.penetrating_vertices = 7, .deepest = 0.3});
  count(figures, world, 1);
  EXPECT_EQ(figures.totals().inside, 7u);
  figures.add({.penetrating_vertices = 2, .deepest = 0.1});
  EXPECT_EQ(figures.totals().inside, 2u);
  EXPECT_EQ(figures.totals().depth, 0.1);
  EXPECT_EQ(figures.totals().most_inside, 7u);
  EXPECT_EQ(figures.totals().deepest, 0.3);
}

TEST(RunFigures, GoesBackToWhatItWasAtThatFrame) {
  softbody::World world = world_by("multi-level-sb");
  compare::RunFigures figures;
  count(figures, world, 3);
  const compare::RunTotals third = figures.totals();
  count(figures, world, 2);
  figures.add({.penetrating_vertices = 7, .deepest = 0.3});
  figures.go_back(5);
  EXPECT_EQ(figures.totals().frames, 5) << "nothing comes after the last frame";
  EXPECT_TRUE(figures.missed().empty()) << "vertices may have other numbers";
  figures.go_back(3);
  EXPECT_EQ(figures.totals().frame, 3);
  EXPECT_EQ(figures.totals().true_contacts, third.true_contacts);
  EXPECT_EQ(figures.totals().missed, third.missed);
  EXPECT_EQ(figures.totals().most_inside, 0u);
  EXPECT_TRUE(figures.missed().empty());
  figures.go_back(0);
  EXPECT_EQ(figures.totals().frames, 0);
  EXPECT_EQ(figures.totals().recall(), 1);
}

/// A world that is looked at from its third frame on.
TEST(RunFigures, CountsTheFramesThatItHasSeen) {
  softbody::World world = world_by("multi-level-sb");
  for (int i = 0; i < 3; ++i) world.step();
  compare::RunFigures figures;
  count(figures, world, 2);
  EXPECT_EQ(figures.totals().frame, 5);
  EXPECT_EQ(figures.totals().frames, 2);
  figures.go_back(3);
  EXPECT_EQ(figures.totals().frames, 0);
}

}  // namespace THIS_FILE
}  // namespace app
