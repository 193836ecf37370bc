#include "app/ui/tour/tour.h"

#include <glm/geometric.hpp>

#include "app/ui/shortcuts.h"
#include "app/ui/tour/body_subset.h"
#include "app/ui/tour/figures.h"
#include "app/window/preferences.h"
#include "engine/resources.h"
#include "tests/app/hands.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace {

const std::size_t last_step = ui::tour_steps().size() - 1;

bool all_shown(const PanelRig& rig, const std::vector<ui::TourFigure>& figures) {
  return std::ranges::all_of(figures,
                             [&](const ui::TourFigure& figure) { return rig.recorder.find(figure.label) != nullptr; });
}

TEST(Tour, GoesThroughEveryStepByMouse) {
  PanelRig rig;
  rig.click("Tour");
  ASSERT_TRUE(rig.ui.tour.open());
  for (std::size_t step = 0; step <= last_step; ++step) {
    ASSERT_EQ(rig.ui.tour.step(), step);
    const auto context = rig.ui.tour.context(rig.session);
    ASSERT_TRUE(context);
    EXPECT_TRUE(all_shown(rig, ui::tour_steps()[step].figures(*context))) << step;
    EXPECT_TRUE(all_shown(rig, ui::figures_of_frame(*context)));
    EXPECT_EQ(rig.widget("Back").enabled, step > 0);
    EXPECT_EQ(rig.widget("Next").enabled, step < last_step);
    if (step < last_step) rig.click("Next");
  }
  rig.click("Back");
  EXPECT_EQ(rig.ui.tour.step(), last_step - 1);
  rig.click("Close tour");
  EXPECT_FALSE(rig.ui.tour.open());
}

TEST(Tour, GoesThroughEveryStepByKeys) {
  PanelRig rig;
  const auto key = [&](int which) { ui::handle_key(which, false, rig.session, rig.ui); };
  key(GLFW_KEY_RIGHT);
  EXPECT_FALSE(rig.ui.tour.open());
  key(GLFW_KEY_G);
  for (std::size_t step = 0; step < last_step + 2; ++step) key(GLFW_KEY_RIGHT);
  EXPECT_EQ(rig.ui.tour.step(), last_step);
  key(GLFW_KEY_LEFT);
  EXPECT_EQ(rig.ui.tour.step(), last_step - 1);
  key(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(rig.ui.tour.open());
  key(GLFW_KEY_G);
  EXPECT_EQ(rig.ui.tour.step(), 0u);
}

TEST(Tour, RestoresPauseOverlaysAndBucket) {
  for (const bool paused : {false, true}) {
    PanelRig rig;
    rig.session.simulation.clock.paused = paused;
    rig.ui.overlays.contacts = true;
    rig.session.inspector.select_bucket(3);
    rig.ui.tour.start(rig.session, rig.ui.overlays);
    EXPECT_TRUE(rig.session.simulation.clock.paused);
    EXPECT_FALSE(rig.ui.overlays.any());
    EXPECT_FALSE(rig.session.inspector.selected_bucket());
    EXPECT_TRUE(window::preferences_of(rig.session, rig.ui, {}).overlays.contacts);
    rig.frames(3);
    rig.ui.tour.close(rig.session, rig.ui.overlays);
    EXPECT_EQ(rig.session.simulation.clock.paused, paused);
    EXPECT_TRUE(rig.ui.overlays.contacts);
    EXPECT_EQ(rig.session.inspector.selected_bucket(), 3u);
  }
}

TEST(Tour, LetsTheUserResumeTheWorld) {
  PanelRig rig;
  rig.session.simulation.clock.paused = true;
  rig.ui.tour.start(rig.session, rig.ui.overlays);
  ui::handle_key(GLFW_KEY_SPACE, false, rig.session, rig.ui);
  const int frame = rig.session.world().frame();
  rig.frames(5);
  EXPECT_GT(rig.session.world().frame(), frame);
  EXPECT_TRUE(rig.ui.tour.context(rig.session));
  rig.ui.tour.close(rig.session, rig.ui.overlays);
  EXPECT_FALSE(rig.session.simulation.clock.paused);
}

TEST(Tour, HashesTheChosenCornerAsTheMethodDoes) {
  PanelRig rig;
  rig.ui.tour.start(rig.session, rig.ui.overlays);
  rig.ui.tour.next();
  rig.ui.tour.next();
  rig.frames(3);
  const collide::methods::CellHash hash(rig.session.world().collision());
  for (std::size_t corner = 0; corner < 8; ++corner) {
    rig.click("Corner " + std::to_string(corner + 1));
    const auto context = rig.ui.tour.context(rig.session);
    ASSERT_EQ(context->corner, corner);
    const ui::HashedCorner& chosen = context->chosen();
    EXPECT_EQ(chosen.bucket, hash.bucket(hash.cell(chosen.at.x, chosen.at.y, chosen.at.z)));
    const std::string result = ui::tour_steps()[2].figures(*context).back().value;
    EXPECT_TRUE(result.ends_with("->  " + grouped(chosen.bucket))) << result;
  }
}

/// The formula that the tour writes out gives the bucket that it states, negative cells included.
TEST(Tour, WritesOutTheHashOfItsBucket) {
  Session session(touching_pair(), {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown);
  tour.update(session);
  for (std::size_t i = 0; i < 8; ++i) {
    tour.choose_corner(i);
    const auto context = tour.context(session);
    std::int64_t sum = 0;
    const auto& settings = session.world().collision();
    for (std::size_t axis = 0; axis < 3; ++axis) sum += context->chosen().cell[axis] * settings.primes[axis];
    const std::int64_t n = settings.buckets;
    EXPECT_EQ(((sum % n) + n) % n, context->chosen().bucket);
  }
}

TEST(ExampleFinder, FindsTouchingBodiesAndAllTheirContacts) {
  Session session(touching_pair(), {}, 1);
  const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->touching);
  EXPECT_EQ(found->body, 0u);
  EXPECT_EQ(found->other, 1u);
  EXPECT_EQ(found->contacts,
            session.world().detection().contacts);  // the exact method drives, and no other bodies touch
  EXPECT_LT(found->distance, session.world().collision().tolerance);
  const compare::BucketContents bucket = found->table.bucket(found->corners[found->corner].bucket);
  EXPECT_GT(bucket.groups.size() + bucket.items, 2u);
}

TEST(ExampleFinder, FindsTheSameWhicheverMethodDrives) {
  Session session(touching_pair(), {}, 1);
  const auto before = ui::ExampleFinder().find(session.world(), std::nullopt);
  for (const collide::Method& method : collide::method_table()) {
    session.settings.set_method(method.key);
    const auto now = ui::ExampleFinder().find(session.world(), std::nullopt);
    EXPECT_EQ(now->box, before->box) << method.key;
    EXPECT_EQ(now->contacts, before->contacts) << method.key;
    EXPECT_EQ(now->missed, before->missed) << method.key;
    EXPECT_EQ(now->work.hashes, 8 * now->structure.boxes.size()) << method.key;
  }
}

TEST(ExampleFinder, FindsWhatSmallCellsMiss) {
  Session session(touching_pair(), {}, 1);
  collide::Settings settings = session.world().collision();
  settings.cell_size = glm::vec3(0.13f);
  settings.buckets = 1'000'003;
  session.settings.set_collision(settings, false);
  const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
  ASSERT_TRUE(found->missed);
  EXPECT_FALSE(found->missed->empty());
  session.settings.set_method("multi-level-sb");
  EXPECT_EQ(found->contacts.size() - found->missed->size(), session.world().detection().contacts.size());
}

TEST(ExampleFinder, FindsTheClosestVerticesIfThereAreNoContacts) {
  Session session(without_solids(), {}, 1);
  const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
  ASSERT_TRUE(found && found->closest);
  EXPECT_FALSE(found->touching);
  const collide::Frame f = session.world().positions();
  float min_squared = 1e9f;
  for (collide::Index a = 0; a < f.bodies->first[1]; ++a)
    for (collide::Index b = f.bodies->first[1]; b < f.bodies->first[2]; ++b)
      min_squared = std::min(min_squared, collide::squared_distance(f.x[a], f.y[a], f.z[a], f.x[b], f.y[b], f.z[b]));
  EXPECT_NEAR(found->distance, std::sqrt(min_squared), 1e-6);
  PanelRig rig(1, without_solids());
  rig.session.simulation.clock.paused = true;
  rig.ui.tour.start(rig.session, rig.ui.overlays);
  for (std::size_t i = 0; i < last_step; ++i) rig.ui.tour.next();
  rig.frames(3);
  EXPECT_TRUE(rig.recorder.find("Contacts"));  // "none yet", and what to wait for
}

TEST(ExampleFinder, PrefersTheSelectedBodyIfItTouches) {
  softbody::Scene scene = touching_pair();
  softbody::BodySource third = scene.bodies[1];
  third.position.x += 1.02;
  scene.bodies.push_back(third);
  Session session(scene, {}, 1);
  const auto found = ui::ExampleFinder().find(session.world(), 2);
  EXPECT_EQ(found->other, 2u);
}

TEST(Tour, SaysThatTheWorldHasNoBodies) {
  softbody::Scene scene = touching_pair();
  scene.bodies.clear();
  PanelRig rig(1, scene);
  rig.click("Tour");
  EXPECT_FALSE(rig.ui.tour.context(rig.session));
  EXPECT_TRUE(rig.recorder.find("Tour problem"));
  EXPECT_EQ(rig.ui.tour.highlight(), nullptr);
}

TEST(Tour, WorksInEveryScene) {
  const auto folder = engine::find_folder("assets") / "scenes";
  for (const std::string& key : softbody::scene_keys(folder)) {
    if (key == "drop-3000") continue;  // takes a minute under the sanitizers
    Session session(softbody::find_scene(key, folder), folder, 1);
    for (int i = 0; i < 5; ++i) session.advance(tick);
    ui::Tour tour;
    render::Overlays shown;
    tour.start(session, shown);
    for (std::size_t step = 0; step <= last_step; ++step, tour.next()) {
      tour.update(session);
      const auto context = tour.context(session);
      ASSERT_EQ(context.has_value(), session.world().bodies().count() > 0) << key;
      if (!context) break;
      EXPECT_FALSE(ui::tour_steps()[step].figures(*context).empty()) << key;
      EXPECT_GT(tour.highlight()->radius, 0) << key;
      EXPECT_FALSE(tour.highlight()->bodies.empty()) << key;
    }
  }
}

TEST(BodySubset, HasTheWorldsPositionsAndIndices) {
  Session session(touching_pair(), {}, 1);
  const collide::Frame all = session.world().positions();
  const ui::BodySubset second(session.world(), 1, 1);
  ASSERT_EQ(second.frame().x.size(), all.bodies->size(1));
  EXPECT_EQ(second.frame().x[5], all.x[all.bodies->first[1] + 5]);
  EXPECT_EQ(second.to_world({3, 4}).b, all.bodies->first[1] + 4);
}

}  // namespace
}  // namespace app
