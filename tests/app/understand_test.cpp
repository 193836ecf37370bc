// What the window explains: the bucket inspector and the light.

#include "app/ui/bucket_view.h"
#include "app/ui/panel/light.h"
#include "tests/app/panel_rig.h"
#include "tests/bucket_loads.h"

namespace app {
namespace {

/// The fullest bucket of the session's table.
std::uint32_t fullest(const Session& session) {
  return std::ranges::max_element(session.debug().loads, {}, &collide::BucketLoad::load)->bucket;
}

TEST(BucketInspector, GroupsTheBucketByCellsAndLetsOneBeChosen) {
  PanelRig rig;
  collide::Settings settings = rig.session.world().collision();
  settings.buckets = 7;  // few, so that cells share
  rig.session.set_collision(settings, true);
  rig.session.paused = true;
  EXPECT_FALSE(rig.recorder.find("Same cell / aliased"));
  rig.session.select_bucket(fullest(rig.session));
  rig.frames(3);
  EXPECT_TRUE(rig.recorder.find("Same cell / aliased"));
  EXPECT_TRUE(rig.recorder.find("Whole table"));
  ASSERT_GT(rig.session.bucket()->groups.size(), 1u);
  const Cell second = rig.session.bucket()->groups[1].cell;
  rig.click("Cell " + cell_text(second));
  EXPECT_EQ(rig.session.selected_cell(), second);
}

TEST(BucketInspector, TakesTheNumberOfAnother) {
  PanelRig rig;
  rig.session.paused = true;
  rig.session.select_bucket(3);
  rig.frames(2);
  rig.type("Bucket number", "622");
  EXPECT_EQ(rig.session.selected_bucket(), 622u);
  rig.type("Bucket number", "5000");
  EXPECT_EQ(rig.session.selected_bucket(), rig.session.world().collision().buckets - 1) << "the last one";
  rig.click("Close Bucket");
  EXPECT_EQ(rig.session.bucket(), nullptr);
}

TEST(BucketInspector, ShowsVerticesWhereTheMethodHashesThese) {
  PanelRig rig;
  rig.session.set_method("grid-hash");
  rig.session.select_bucket(fullest(rig.session));
  rig.frames(2);
  EXPECT_TRUE(rig.session.bucket()->vertices);
  EXPECT_TRUE(rig.recorder.find("Same cell / aliased"));
}

TEST(BucketInspector, FollowsTheStateAndEndsWithTheTable) {
  PanelRig rig;
  rig.session.select_bucket(5);
  ASSERT_NE(rig.session.bucket(), nullptr);
  const auto revision = rig.session.revision();
  rig.frames(2);
  EXPECT_NE(rig.session.revision(), revision);
  EXPECT_EQ(rig.session.bucket()->items, tests::bucket_loads(rig.session.debug())[5]);
  rig.session.select_bucket(std::nullopt);
  EXPECT_EQ(rig.session.bucket(), nullptr);
}

TEST(BucketInspector, NamesBodiesShortly) {
  collide::DebugGeometry debug;
  for (collide::Index body : {4u, 1u, 1u, 9u, 12u}) debug.boxes.push_back({{}, {}, body});
  const auto text = [&](std::vector<collide::Index> items) { return bodies_of({{}, std::move(items)}, {}, debug, {}); };
  EXPECT_EQ(text({0}), "body 4");
  EXPECT_EQ(text({1, 2}), "body 1");
  EXPECT_EQ(text({0, 1}), "bodies 1 and 4");
  EXPECT_EQ(text({0, 1, 2, 3}), "bodies 1, 4 and 9");
  EXPECT_EQ(text({0, 1, 3, 4}), "bodies 1, 4 and 2 more");
}

TEST(Light, SaysWhichBoxExceedsACellAlongWhichAxis) {
  collide::DebugGeometry paper;
  paper.boxes = {{{0, 0, 0}, {0.5f, 0.25f, 0.75f}, 0}, {{1, 1, 1}, {1.25f, 1.5f, 1.25f}, 1}};
  EXPECT_NE(box_against_cell(paper, glm::vec3(0.75f)).find("Every box fits"), std::string::npos);
  const std::string beyond = box_against_cell(paper, {0.4f, 0.6f, 0.7f});
  EXPECT_NE(beyond.find("Along x, z a box is larger"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("0.500 x 0.500 x 0.750 m"), std::string::npos) << beyond;
  EXPECT_NE(box_against_cell({}, glm::vec3(1)).find("pause"), std::string::npos);
}

TEST(Light, ExplainsItselfAtAClick) {
  PanelRig rig;
  EXPECT_FALSE(rig.recorder.find("Coverage explained"));
  rig.click("Coverage");
  EXPECT_TRUE(rig.recorder.find("Coverage explained"));
  rig.click("Coverage");
  EXPECT_FALSE(rig.recorder.find("Coverage explained"));
}

/// The light of the literal method agrees with the largest box that its explanation states.
TEST(Light, AgreesWithTheLiteralMethod) {
  PanelRig rig;
  rig.session.set_method("multi-level-sb");
  for (const float cell : {0.2f, 2.0f}) {
    collide::Settings settings = rig.session.world().collision();
    settings.cell_size = glm::vec3(cell);
    rig.session.set_collision(settings, false);
    const bool fits = rig.session.world().detection().coverage == collide::Coverage::covered;
    const std::string text = box_against_cell(rig.session.paper(), settings.cell_size);
    EXPECT_EQ(text.find("Every box fits") != text.npos, fits) << text;
  }
}

}  // namespace
}  // namespace app
