// The views of the hash table and of a bucket.

#include "app/ui/views/views.h"

#include <algorithm>

#include "app/ui/widgets/bucket_grid.h"
#include "tests/app/panel_rig.h"
#include "tests/bucket_loads.h"

namespace app {
namespace THIS_FILE {

collide::BucketLoad fullest_bucket(const Session& session) {
  return *std::ranges::max_element(session.inspector.shown_geometry().loads, {}, &collide::BucketLoad::load);
}

ui::BucketGrid grid_of(const PanelRig& rig) {
  const auto [min, max] = rig.area("Buckets of the table");
  const std::uint32_t buckets = rig.session.world().collision().buckets;
  return ui::BucketGrid::fit(buckets, max.x - min.x, max.y - min.y, ui::min_square);
}

void click_square(PanelRig& rig, std::uint32_t square) {
  const ImVec2 origin = rig.area("Buckets of the table").min;
  const ui::BucketGrid grid = grid_of(rig);
  rig.click_at(origin.x + (static_cast<float>(square % grid.columns) + 0.5f) * grid.side,
               origin.y + (static_cast<float>(square / grid.columns) + 0.5f) * grid.side);
}

TEST(DrawHashTable, EndsItsScaleAtTheFullestBucket) {
  PanelRig rig;
  rig.session.simulation.clock.paused = true;
  for (const std::uint32_t buckets : {7u, 1001u}) {
    rig.change([&](softbody::Scene& scene) { scene.collision.buckets = buckets; });
    rig.frames(2);
    rig.hover("Load scale");
    const std::string load = grouped(fullest_bucket(rig.session).load);
    EXPECT_NE(rig.recorder.tooltip.find(", " + load + " in the fullest"), std::string::npos) << rig.recorder.tooltip;
  }
}

TEST(BucketView, GroupsEntriesByCellsAndSelectsACell) {
  PanelRig rig;
  rig.change([](softbody::Scene& scene) { scene.collision.buckets = 7; });  // few, so that cells share
  rig.session.simulation.clock.paused = true;
  EXPECT_FALSE(rig.recorder.find("Pairs"));
  rig.session.inspector.select_bucket(fullest_bucket(rig.session).bucket);
  rig.frames(3);
  EXPECT_TRUE(rig.recorder.find("Pairs"));
  EXPECT_TRUE(rig.recorder.find("All pairs"));
  ASSERT_GT(rig.session.inspector.bucket()->groups.size(), 1u);
  const compare::Cell second = rig.session.inspector.bucket()->groups[1].cell;
  rig.click("Cell " + compare::cell_text(second));
  EXPECT_EQ(rig.session.inspector.selected_cell(), second);
}

TEST(BucketView, SelectsABucketByItsNumber) {
  PanelRig rig;
  rig.session.simulation.clock.paused = true;
  rig.session.inspector.select_bucket(3);
  rig.frames(2);
  rig.type("Bucket number", "622");
  EXPECT_EQ(rig.session.inspector.selected_bucket(), 622u);
  rig.type("Bucket number", "5000");
  EXPECT_EQ(rig.session.inspector.selected_bucket(), rig.session.world().collision().buckets - 1) << "the last one";
  rig.click("Close Bucket");
  EXPECT_EQ(rig.session.inspector.bucket(), nullptr);
}

TEST(BucketView, ShowsThePresentStateUntilTheBucketIsDeselected) {
  PanelRig rig;
  rig.session.inspector.select_bucket(5);
  ASSERT_NE(rig.session.inspector.bucket(), nullptr);
  const auto revision = rig.session.simulation.revision();
  rig.frames(2);
  EXPECT_NE(rig.session.simulation.revision(), revision);
  EXPECT_EQ(rig.session.inspector.bucket()->items, tests::bucket_loads(rig.session.inspector.shown_geometry())[5]);
  rig.session.inspector.select_bucket(std::nullopt);
  EXPECT_EQ(rig.session.inspector.bucket(), nullptr);
}

TEST(BucketView, AbbreviatesListsOfBodies) {
  collide::DebugGeometry debug;
  for (collide::Index body : {4u, 1u, 1u, 9u, 12u}) debug.boxes.push_back({{}, {}, body});
  const auto text = [&](std::vector<collide::Index> items) {
    return compare::bodies_text({{}, std::move(items)}, {}, debug, {});
  };
  EXPECT_EQ(text({0}), "body 4");
  EXPECT_EQ(text({1, 2}), "body 1");
  EXPECT_EQ(text({0, 1}), "bodies 1 and 4");
  EXPECT_EQ(text({0, 1, 2, 3}), "bodies 1, 4 and 9");
  EXPECT_EQ(text({0, 1, 3, 4}), "bodies 1, 4 and 2 more");
}

TEST(DrawHashTable, SelectsTheClickedBucketAndDeselectsItAtASecondClick) {
  PanelRig rig;
  click_square(rig, 345);
  EXPECT_EQ(rig.session.inspector.selected_bucket(), 345u);
  click_square(rig, 345);
  EXPECT_FALSE(rig.session.inspector.selected_bucket());
}

TEST(DrawHashTable, SelectsTheFullestBucketOfTheClickedSquare) {
  PanelRig rig;
  rig.change([](softbody::Scene& scene) { scene.collision.buckets = 1'000'003; });
  rig.session.simulation.clock.paused = true;
  rig.frames(2);
  const std::uint32_t per_square = grid_of(rig).per_square;
  ASSERT_GT(per_square, 1u);
  const collide::BucketLoad fullest = fullest_bucket(rig.session);
  click_square(rig, fullest.bucket / per_square);
  ASSERT_TRUE(rig.session.inspector.selected_bucket());
  const auto& loads = rig.session.inspector.shown_geometry().loads;
  const auto selected =
      std::ranges::find(loads, *rig.session.inspector.selected_bucket(), &collide::BucketLoad::bucket);
  ASSERT_NE(selected, loads.end());
  EXPECT_EQ(selected->load, fullest.load);
}

}  // namespace THIS_FILE
}  // namespace app
