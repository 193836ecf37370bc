#include "app/ui/tour/tour.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "app/compare/score.h"
#include "app/render/palette.h"
#include "app/ui/tour/paper_boxes.h"
#include "app/ui/tour/steps.h"
#include "app/window/preferences.h"
#include "engine/resources.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"
#include "tests/app/scenes.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

const std::size_t last_step = ui::tour_steps().size() - 1;

/// touching_pair() a little higher, so that it touches nothing at first and hits the sphere later.
softbody::Scene falling_pair() {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].position = {0, 2.9, 0};
  scene.bodies[1].position = {0.1, 4.5, 0};
  scene.collision.tolerance = 0.05f;
  return scene;
}

softbody::Scene shipped_scene(const std::string& key) {
  return softbody::find_scene(key, engine::find_folder("assets") / "scenes");
}

/// A tour that was opened at a step.
struct TourRig {
  explicit TourRig(const files::Opened& opened, std::size_t step = 0) : session(opened, {}, 1) {
    tour.start(session, shown, step);
    tour.update(session);
  }
  /// Advances until the run ahead of the tour is over.
  void finish_run() {
    while (session.run_ahead.active()) {
      tour.update(session);
      session.advance(tick);
    }
    tour.update(session);
  }
  /// The tour must have an example.
  ui::TourContext context() const { return tour.context(session).value(); }

  Session session;
  ui::Tour tour;
  render::Overlays shown;
};

/// Returns what the paper's method misses in the world, by the detectors themselves.
std::vector<collide::Contact> misses_of(const softbody::BodiesInMotion& world) {
  const collide::Method& paper = *collide::find_method(collide::paper_method);
  return compare::score(detected(paper, world.positions(), world.collision()).contacts, true_contacts(world)).missed;
}

std::optional<ui::TourExample> example_of(const softbody::Scene& scene,
                                          std::optional<softbody::BodyId> preferred = {}) {
  return ui::ExampleFinder().find(softbody::World(scene, {}), preferred);
}

/// Returns the width of a figure whose label and value do not overlap. The font must be known, as after a frame.
float width_of(const ui::TourFigure& figure) {
  return ImGui::CalcTextSize(figure.label.c_str()).x + ImGui::GetStyle().ItemSpacing.x +
         ImGui::CalcTextSize(figure.value.c_str()).x;
}

bool all_shown(const PanelRig& rig, const std::vector<ui::TourFigure>& figures) {
  return std::ranges::all_of(figures,
                             [&](const ui::TourFigure& figure) { return rig.recorder.find(figure.label) != nullptr; });
}

TEST(Tour, GoesThroughEveryStepByMouseAndKeys) {
  PanelRig rig;
  const auto press = [&](int key) {
    handle_key(key, false, rig.session, rig.ui);
    rig.frames(2);
  };
  press(GLFW_KEY_RIGHT);
  EXPECT_FALSE(rig.ui.tour.open());
  rig.click("Tour");
  ASSERT_TRUE(rig.ui.tour.open());
  for (std::size_t step = 0; step <= last_step; ++step) {
    ASSERT_EQ(rig.ui.tour.step(), step);
    const auto context = rig.ui.tour.context(rig.session);
    ASSERT_TRUE(context);
    EXPECT_TRUE(all_shown(rig, ui::tour_steps()[step].figures(*context))) << step;
    EXPECT_TRUE(all_shown(rig, ui::figures_of_frame(context->f.work)));
    EXPECT_EQ(rig.widget("Back").enabled, step > 0);
    EXPECT_EQ(rig.widget("Next").enabled, step < last_step);
    step % 2 || step == last_step ? press(GLFW_KEY_RIGHT) : rig.click("Next");
  }
  EXPECT_EQ(rig.ui.tour.step(), last_step) << "there is no further one";
  rig.click("Back");
  press(GLFW_KEY_LEFT);
  EXPECT_EQ(rig.ui.tour.step(), last_step - 2);
  rig.click("Close tour");
  EXPECT_FALSE(rig.ui.tour.open());
  press(GLFW_KEY_G);
  EXPECT_TRUE(rig.ui.tour.open());
  EXPECT_EQ(rig.ui.tour.step(), 0u);
  press(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(rig.ui.tour.open());
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
    EXPECT_TRUE(window::preferences_of(rig.session, rig.ui, {}).shown.overlays.contacts);
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
  handle_key(GLFW_KEY_SPACE, false, rig.session, rig.ui);
  const int frame = rig.session.world().frame();
  rig.frames(5);
  EXPECT_GT(rig.session.world().frame(), frame);
  EXPECT_TRUE(rig.ui.tour.context(rig.session));
  rig.ui.tour.close(rig.session, rig.ui.overlays);
  EXPECT_FALSE(rig.session.simulation.clock.paused);
}

TEST(Tour, WritesOutTheHashOfTheChosenCorner) {
  PanelRig rig;
  rig.ui.tour.start(rig.session, rig.ui.overlays, 2);
  rig.frames(3);
  const collide::Settings& settings = rig.session.world().collision();
  const collide::methods::CellHash hash(settings);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    rig.click("Corner " + std::to_string(corner + 1));
    const auto context = rig.ui.tour.context(rig.session);
    ASSERT_EQ(context->chosen, corner);
    const ui::HashedCorner& chosen = context->hashed_corner();
    EXPECT_EQ(chosen.bucket, hash.bucket(hash.cell(chosen.at.x, chosen.at.y, chosen.at.z)));
    const std::string result = ui::tour_steps()[2].figures(*context).back().value;
    EXPECT_TRUE(result.ends_with("->  " + grouped(chosen.bucket))) << result;
    std::int64_t sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) sum += chosen.cell[axis] * settings.primes[axis];
    const std::int64_t n = settings.buckets;
    EXPECT_EQ(((sum % n) + n) % n, chosen.bucket) << "of negative cells, too";
  }
}

TEST(ExampleFinder, FindsTouchingBodiesAndAllTheirContacts) {
  const softbody::World world(touching_pair(), {});
  const auto found = ui::ExampleFinder().find(world, std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->touching);
  EXPECT_EQ(found->body, 0u);
  EXPECT_EQ(found->other, 1u);
  EXPECT_EQ(found->contacts, world.detection().contacts);  // the exact method drives, and no other bodies touch
  EXPECT_LT(found->distance, world.collision().tolerance);
  const compare::BucketContents bucket = found->table.bucket(found->corners[found->corner].bucket);
  EXPECT_GT(bucket.groups.size() + bucket.items, 2u);
}

TEST(ExampleFinder, FindsTheSameWhicheverMethodDrives) {
  softbody::Scene scene = touching_pair();
  const auto before = example_of(scene);
  for (const collide::Method& method : collide::method_table()) {
    scene.method = method.key;
    const auto now = example_of(scene);
    EXPECT_EQ(now->box, before->box) << method.key;
    EXPECT_EQ(now->contacts, before->contacts) << method.key;
    EXPECT_EQ(now->missed, before->missed) << method.key;
    EXPECT_EQ(now->work.hashes, 8 * now->structure.boxes.size()) << method.key;
  }
}

TEST(ExampleFinder, FindsTheClosestVerticesIfThereAreNoContacts) {
  softbody::Scene scene = without_solids();
  softbody::BodySource far = scene.bodies[0];
  far.position.y += 20;
  scene.bodies.insert(scene.bodies.begin(), far);
  const softbody::World world(scene, {});
  const auto found = ui::ExampleFinder().find(world, 2);
  ASSERT_TRUE(found && found->closest);
  EXPECT_FALSE(found->touching);
  const collide::Frame f = world.positions();
  const auto distance = [&](collide::Index a, collide::Index b) {
    return glm::distance(position(f, a), position(f, b));
  };
  float nearest = 1e9f;
  for (collide::Index a = f.bodies->first[1]; a < f.bodies->first[2]; ++a)
    for (collide::Index b = f.bodies->first[2]; b < f.bodies->first[3]; ++b)
      nearest = std::min(nearest, distance(a, b));
  EXPECT_NEAR(found->distance, nearest, 1e-6);
  EXPECT_NEAR(distance(found->closest->a, found->closest->b), nearest, 1e-6);
}

TEST(ExampleFinder, PrefersTheSelectedBodyIfItTouches) {
  softbody::Scene scene = touching_pair();
  softbody::BodySource third = scene.bodies[1];
  third.position.x += 1.02;
  scene.bodies.push_back(third);
  EXPECT_EQ(example_of(scene, 2)->other, 2u);
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

TEST(Tour, WorksWithEveryKindOfBody) {
  for (const char* key : {"A", "cloth", "drop", "shapes", "star"}) {
    Session session(shipped_scene(key), {}, 1);
    for (int i = 0; i < 5; ++i) session.advance(tick);
    ui::Tour tour;
    render::Overlays shown;
    tour.start(session, shown);
    session.run_ahead.stop();  // a contact may be far
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

TEST(Tour, RunsAheadToAContact) {
  TourRig rig(shipped_scene("drop"));
  ASSERT_TRUE(rig.tour.running_to(rig.session));
  rig.session.advance(tick);
  EXPECT_GT(rig.session.world().frame(), 1) << "several frames per picture";
  rig.tour.update(rig.session);
  EXPECT_FALSE(rig.tour.context(rig.session));
  EXPECT_EQ(rig.tour.highlight(), nullptr);
  int before = 0;
  for (; rig.session.run_ahead.active(); rig.session.advance(tick)) before = rig.session.world().frame();
  rig.tour.update(rig.session);
  EXPECT_TRUE(rig.context().f.touching);
  EXPECT_TRUE(rig.session.simulation.clock.paused);
  EXPECT_LE(rig.session.world().frame(), before + session::SimulationClock::max_steps);
  rig.tour.close(rig.session, rig.shown);
  EXPECT_FALSE(rig.session.simulation.clock.paused) << "the world goes on from there";
}

TEST(Tour, CanBeClosedWhileTheWorldRunsAhead) {
  for (const bool paused : {false, true}) {
    PanelRig rig(1, falling_pair());
    rig.session.simulation.clock.paused = paused;
    rig.ui.tour.start(rig.session, rig.ui.overlays);
    rig.frame();
    ASSERT_TRUE(rig.recorder.find("Tour runs ahead"));
    const ui::WidgetRecorder::Widget close = rig.widget("Close tour");
    rig.ui.tour.close(rig.session, rig.ui.overlays);
    EXPECT_TRUE(close.enabled);
    EXPECT_FALSE(rig.session.run_ahead.active());
    EXPECT_EQ(rig.session.simulation.clock.paused, paused);
  }
}

TEST(Tour, GivesUpWhereNothingWillTouch) {
  softbody::Scene scene = falling_pair();
  scene.bodies.pop_back();  // alone: comes to rest
  PanelRig rig(1, scene);
  rig.ui.tour.start(rig.session, rig.ui.overlays);
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.run_ahead.active(); }));
  rig.frames(2);
  EXPECT_TRUE(rig.session.simulation.clock.paused);
  ASSERT_TRUE(rig.ui.tour.context(rig.session)) << "explains with the body";
  EXPECT_FALSE(rig.ui.tour.context(rig.session)->f.touching);
  EXPECT_TRUE(rig.recorder.find("Tour lack"));
  EXPECT_EQ(rig.widget("Run ahead").enabled, !rig.session.world().all_at_rest());
}

TEST(Tour, GivesUpAfterAWhile) {
  softbody::Scene scene = without_solids();
  scene.bodies[0].velocity.x = -1;  // away from each other, for ever
  TourRig rig(scene);
  rig.finish_run();
  EXPECT_NEAR(rig.session.world().last_step().time, 20, 0.1);
  EXPECT_TRUE(rig.tour.has_given_up(rig.session));
  EXPECT_TRUE(rig.tour.context(rig.session));
  while (rig.tour.step() < ui::miss_step) rig.tour.next();
  EXPECT_FALSE(rig.tour.has_given_up(rig.session)) << "a page with another goal";
  rig.tour.back();
  EXPECT_TRUE(rig.tour.has_given_up(rig.session));
  rig.session.simulation.clock.single_step();
  rig.session.advance(tick);
  EXPECT_FALSE(rig.tour.has_given_up(rig.session)) << "another frame";
}

TEST(Tour, ExplainsAMissOfThePapersMethod) {
  softbody::Scene scene = shipped_scene("drop");
  scene.collision.levels = 4;
  TourRig rig(scene, ui::miss_step);
  rig.finish_run();
  ASSERT_EQ(rig.tour.step(), ui::miss_step);
  const ui::TourContext context = rig.context();
  ASSERT_TRUE(context.f.miss && context.f.miss->face);
  const ui::ExplainedMiss& miss = *context.f.miss;
  const std::vector<collide::Contact> misses = misses_of(rig.session.world());
  EXPECT_EQ(context.f.all_missed, misses.size());
  EXPECT_TRUE(std::ranges::count(misses, miss.contact));
  EXPECT_NE(miss.corners[0].bucket, miss.corners[1].bucket);
  const int axis = miss.face->axis;
  const float at = static_cast<float>(miss.face->index) * (*rig.session.world().collision().cell_size)[axis];
  std::array boxes{context.f.structure.boxes[miss.boxes[0]], context.f.structure.boxes[miss.boxes[1]]};
  if (boxes[0].lo[axis] > boxes[1].lo[axis]) std::swap(boxes[0], boxes[1]);
  EXPECT_LT(boxes[0].hi[axis], at);
  EXPECT_GE(boxes[1].lo[axis], at);
  const std::string text = ui::tour_steps()[ui::miss_step].text(context);
  EXPECT_NE(text.find("a cell face (dark blue) lies between"), std::string::npos) << text;
}

TEST(Tour, FramesTheBoxesOfAMissAndNotTheirCells) {
  softbody::Scene scene = touching_pair();
  scene.collision.cell_size = glm::vec3{2.47f, 60, 60};  // a face at x = 0, between the bodies
  const TourRig rig(scene, ui::miss_step);
  ASSERT_TRUE(rig.context().f.miss && rig.context().f.miss->face);
  const render::Highlight& highlight = *rig.tour.highlight();
  EXPECT_LT(highlight.radius, 1.0f);
  for (const engine::BoxSet& set : highlight.boxes)
    for (const engine::Box& box : set.boxes)
      for (const glm::vec3& corner : {box.lo, box.hi})
        EXPECT_LT(glm::distance(corner, highlight.centre), 3 * highlight.radius);
}

TEST(Tour, ShowsFewCellsOfAFullBucketAndTheCornersOwnFirst) {
  softbody::Scene scene = touching_pair();
  scene.collision.buckets = 1;
  scene.collision.cell_size = glm::vec3(0.3f);
  TourRig rig(scene, 3);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    rig.tour.choose_corner(corner);
    rig.tour.update(rig.session);
    const ui::TourContext context = rig.context();
    const compare::BucketContents bucket = context.bucket();
    ASSERT_GT(bucket.groups.size(), 3u);
    EXPECT_EQ(bucket.groups.front().cell, context.bucket_corner().cell);
    const std::vector<ui::TourFigure> figures = ui::tour_steps()[3].figures(context);
    EXPECT_EQ(figures[1].colour, render::same_cell_colour);
    EXPECT_EQ(figures[2].colour, render::aliased_colour);
    EXPECT_EQ(figures[4].value, grouped(bucket.groups.size() - 3)) << figures[4].label;
    EXPECT_EQ(rig.tour.highlight()->labels.size(), 3u);
    EXPECT_EQ(rig.tour.highlight()->boxes.size(), 2u) << "a set of cells and one of boxes";
  }
}

TEST(Tour, ShowsTheCellThatALargeBoxSkips) {
  softbody::Scene scene = touching_pair();
  scene.collision.levels = 0;
  scene.collision.cell_size = glm::vec3(0.3f);
  scene.collision.buckets = 1'000'003;
  scene.bodies[1].position = scene.bodies[0].position + glm::dvec3(0.57);  // the boxes overlap
  const auto found = example_of(scene);
  ASSERT_TRUE(found && found->miss);
  const ui::ExplainedMiss& miss = *found->miss;
  ASSERT_TRUE(miss.skipped && !miss.face);
  const collide::methods::CellHash hash(scene.collision);
  int without_corner = 0;
  for (const collide::Index box : miss.boxes) {
    const auto& [lo, hi, body] = found->structure.boxes[box];
    const compare::Cell low = hash.cell(lo.x, lo.y, lo.z), high = hash.cell(hi.x, hi.y, hi.z);
    bool has_corner = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t index = (*miss.skipped)[axis];
      EXPECT_TRUE(low[axis] <= index && index <= high[axis]);
      has_corner = has_corner && (index == low[axis] || index == high[axis]);
    }
    without_corner += !has_corner;
  }
  EXPECT_GT(without_corner, 0);
}

TEST(Tour, SaysThatNothingIsMissedAndRunsAheadToAMiss) {
  softbody::Scene scene = shipped_scene("drop");
  scene.collision.levels = 4;
  PanelRig rig(1, scene);
  rig.ui.tour.start(rig.session, rig.ui.overlays);
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.run_ahead.active(); }));
  for (std::size_t i = 0; i < ui::miss_step; ++i) rig.ui.tour.next();
  rig.frames(3);
  ASSERT_TRUE(misses_of(rig.session.world()).empty());
  EXPECT_TRUE(rig.recorder.find("Tour lack"));
  rig.click("Run ahead");
  EXPECT_TRUE(rig.recorder.find("Tour runs ahead"));
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.run_ahead.active(); }));
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Tour lack"));
  EXPECT_FALSE(misses_of(rig.session.world()).empty());
}

TEST(Tour, FitsEveryPageIntoSmallWindows) {
  softbody::Scene scene = touching_pair();
  scene.collision.cell_size = glm::vec3(0.13f);
  scene.collision.buckets = collide::max_buckets;
  PanelRig rig(1, scene);
  rig.session.simulation.clock.paused = true;  // the bodies part soon
  const ui::FrameWork of_drop_3000{.bodies = 3125,
                                   .vertices = 506'250,
                                   .boxes = 25'000,
                                   .hashes = 200'000,
                                   .pair_tests = 405'190'390,
                                   .all_pairs = 128'144'278'125,
                                   .pair_tests_estimated = true};
  for (const glm::ivec2 size :
       {glm::ivec2(640, 480), glm::ivec2(500, 400), glm::ivec2(800, 500), glm::ivec2(1280, 720)}) {
    rig.resize(size.x, size.y);
    rig.ui.tour.start(rig.session, rig.ui.overlays);
    for (std::size_t step = 0; step <= last_step; ++step, rig.ui.tour.next()) {
      rig.frames(3);
      const auto context = rig.ui.tour.context(rig.session);
      ASSERT_TRUE(context && context->f.miss);
      for (const ui::TourFigure& figure : ui::tour_steps()[step].figures(*context))
        EXPECT_LE(rig.widget(figure.label).max.x, static_cast<float>(size.x)) << figure.label << " at " << size.x;
      const ui::WidgetRecorder::Widget row = rig.widget("All pairs");
      for (const ui::TourFigure& figure : ui::figures_of_frame(of_drop_3000))
        EXPECT_LE(width_of(figure), row.max.x - row.min.x) << figure.label << ": " << figure.value << " at " << size.x;
      for (const char* label : {"Back", "Next", "Close tour"}) {
        EXPECT_LE(rig.widget(label).max.x, static_cast<float>(size.x)) << label;
        EXPECT_LE(rig.widget(label).max.y, static_cast<float>(size.y)) << label;
      }
    }
    const ui::ScreenRect area = rig.interface.scene_area();
    EXPECT_GT(area.max.x - area.min.x, 200);
    EXPECT_GT(area.max.y - area.min.y, 150);
    rig.ui.tour.close(rig.session, rig.ui.overlays);
  }
}

TEST(Tour, SpeaksOfAliasingOnlyWhereItShowsIt) {
  softbody::Scene scene = touching_pair();
  for (const std::uint32_t buckets : {7u, 1'000'003u}) {
    scene.collision.buckets = buckets;
    const TourRig rig(scene);
    const ui::TourContext context = rig.context();
    const bool aliased = context.f.table.bucket(context.bucket_corner().bucket).groups.size() > 1;
    EXPECT_EQ(aliased, buckets == 7);
    const std::string text = ui::tour_steps()[3].text(context);
    EXPECT_EQ(text.find("orange") != std::string::npos, aliased) << text;
  }
}

TEST(Tour, FindsAliasingInAnotherBox) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].position.x -= 0.2;
  for (std::uint32_t buckets = 30; buckets < 400; ++buckets) {
    scene.collision.buckets = buckets;
    const auto found = example_of(scene);
    if (!found->aliased_corner) continue;
    EXPECT_GT(found->table.bucket(found->aliased_corner->bucket).groups.size(), 1u);
    for (const ui::HashedCorner& corner : found->corners)
      EXPECT_EQ(found->table.bucket(corner.bucket).groups.size(), 1u);
    return;
  }
  FAIL() << "every table has an aliased bucket at the nearest box, or none at all";
}

TEST(MissedContacts, AreThoseThatTheDetectorMisses) {
  std::size_t missed = 0;
  for (const int levels : {0, 3, 5, 8, collide::max_levels}) {
    for (const float cell : {0.07f, 0.3f, 0.7f}) {
      softbody::Scene scene = touching_pair();
      scene.collision.levels = levels;
      scene.collision.cell_size = glm::vec3(cell, 1.1f * cell, 0.9f * cell);
      Session session(scene, {}, 1);
      for (const int frames : {0, 10}) {
        for (int i = 0; i < frames; ++i) session.advance(tick);
        const std::vector<collide::Contact> expected = misses_of(session.world());
        const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
        EXPECT_EQ(ui::missed_contacts(found->structure, session.world().positions(), true_contacts(session.world())),
                  expected)
            << levels << ' ' << cell;
        EXPECT_EQ(found->all_missed, expected.size());
        EXPECT_EQ(ui::ExampleFinder().has_miss(session.world()), !expected.empty());
        missed += expected.size();
      }
    }
  }
  EXPECT_GT(missed, 0u);
}

}  // namespace THIS_FILE
}  // namespace app
