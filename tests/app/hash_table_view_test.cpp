// The views of the hash table and of a bucket.

#include "app/ui/views/hash_table_view.h"

#include <algorithm>

#include "app/ui/views/views.h"
#include "tests/app/panel_rig.h"
#include "tests/bucket_loads.h"

namespace app {
namespace THIS_FILE {

std::uint32_t fullest_bucket(const Session& session) {
  return std::ranges::max_element(session.inspector.shown_geometry().loads, {}, &collide::BucketLoad::load)->bucket;
}

TEST(TableFigures, AreThoseOfTheDrivingMethodIfItHashes) {
  Session session(touching_pair(), {}, 1);
  for (const collide::Method& method : collide::method_table()) {
    session.settings.set_method(method.key);
    session.simulation.clock.single_step();
    session.advance(tick);
    const ui::TableFigures figures = ui::table_figures(session.inspector.shown_geometry());
    EXPECT_GT(figures.buckets_used, 0u) << method.key << ": else those of the paper's method";
    if (!method.uses_hash) continue;
    const collide::Counters& counters = session.world().detection().counters;
    const std::vector<collide::BucketLoad> loads = session.world().detector().debug().loads;
    EXPECT_EQ(figures.buckets_used, loads.size()) << method.key;
    EXPECT_EQ(figures.longest, std::ranges::max_element(loads, {}, &collide::BucketLoad::load)->load) << method.key;
    EXPECT_EQ(figures.boxes, method.uses_levels ? counters.boxes : 0) << method.key;
  }
}

TEST(BucketView, GroupsEntriesByCellsAndSelectsACell) {
  PanelRig rig;
  collide::Settings settings = rig.session.world().collision();
  settings.buckets = 7;  // few, so that cells share
  rig.session.simulation.change_scene(
      "Settings", [&](softbody::Scene& s) { s.collision = settings, s.collision.cell_size.reset(); });
  rig.session.simulation.clock.paused = true;
  EXPECT_FALSE(rig.recorder.find("Same cell / aliased"));
  rig.session.inspector.select_bucket(fullest_bucket(rig.session));
  rig.frames(3);
  EXPECT_TRUE(rig.recorder.find("Same cell / aliased"));
  EXPECT_TRUE(rig.recorder.find("All buckets"));
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

TEST(BucketView, ShowsVerticesIfTheMethodHashesThem) {
  PanelRig rig;
  rig.session.settings.set_method("grid-hash");
  rig.session.inspector.select_bucket(fullest_bucket(rig.session));
  rig.frames(2);
  EXPECT_TRUE(rig.session.inspector.bucket()->vertices);
  EXPECT_TRUE(rig.recorder.find("Same cell / aliased"));
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

TEST(HashTableView, SelectsTheClickedBucketAndDeselectsItAtASecondClick) {
  PanelRig rig;
  const ui::HashTableView& view = rig.interface.hash_table_view();
  const ui::BucketGrid& grid = view.grid();
  const std::uint32_t square = 345;
  const float x = view.grid_origin().x + (static_cast<float>(square % grid.columns) + 0.5f) * grid.side;
  const float y = view.grid_origin().y + (static_cast<float>(square / grid.columns) + 0.5f) * grid.side;
  rig.click_at(x, y);
  EXPECT_EQ(rig.session.inspector.selected_bucket(), 345u);
  rig.click_at(x, y);
  EXPECT_FALSE(rig.session.inspector.selected_bucket());
}

TEST(HashTableView, SelectsTheFullestBucketOfTheClickedSquare) {
  PanelRig rig;
  collide::Settings settings = rig.session.world().collision();
  settings.buckets = 1'000'003;
  rig.session.simulation.change_scene(
      "Settings", [&](softbody::Scene& s) { s.collision = settings, s.collision.cell_size.reset(); });
  rig.session.simulation.clock.paused = true;
  rig.frames(2);
  const ui::HashTableView& view = rig.interface.hash_table_view();
  ASSERT_GT(view.grid().per_square, 1u);
  const auto loads = rig.session.inspector.shown_geometry().loads;
  const collide::BucketLoad fullest = *std::ranges::max_element(loads, {}, &collide::BucketLoad::load);
  const std::uint32_t square = fullest.bucket / view.grid().per_square;
  rig.click_at(view.grid_origin().x + (static_cast<float>(square % view.grid().columns) + 0.5f) * view.grid().side,
               view.grid_origin().y + (static_cast<float>(square / view.grid().columns) + 0.5f) * view.grid().side);
  ASSERT_TRUE(rig.session.inspector.selected_bucket());
  const auto selected =
      std::ranges::find(loads, *rig.session.inspector.selected_bucket(), &collide::BucketLoad::bucket);
  ASSERT_NE(selected, loads.end());
  EXPECT_EQ(selected->load, fullest.load);
}

}  // namespace THIS_FILE
}  // namespace app
