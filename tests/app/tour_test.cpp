#include "app/ui/tour/tour.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "app/compare/score.h"

#include "app/render/palette.h"
#include "app/ui/shortcuts.h"
#include "app/ui/tour/body_subset.h"
#include "app/ui/tour/paper_boxes.h"
#include "app/ui/tour/steps.h"
#include "app/window/preferences.h"
#include "engine/resources.h"
#include "tests/app/hands.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

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

/// Advances until the run ahead of the tour is over.
void finish_run(Session& session, ui::Tour& tour) {
  while (session.run_ahead.active()) {
    tour.update(session);
    session.advance(tick);
  }
  tour.update(session);
}

/// What the paper's method misses in the world, by the detectors themselves.
std::vector<collide::Contact> misses_of(const softbody::BodiesInMotion& world) {
  std::array<collide::Result, 2> results;
  collide::Workers workers(1);
  for (const bool paper : {false, true})
    collide::find_method(paper ? collide::paper_method : collide::reference_method)
        ->make()
        ->detect(world.positions(), world.collision(), workers, results[paper]);
  return compare::score(results[1].contacts, results[0].contacts).missed;
}

/// What the tour says that the method misses, with the structure of the method.
std::vector<collide::Contact> missed_by(const collide::DebugGeometry& structure,
                                        const softbody::BodiesInMotion& world) {
  collide::Result exact;
  collide::Workers workers(1);
  collide::find_method(collide::reference_method)->make()->detect(world.positions(), world.collision(), workers, exact);
  return ui::missed_contacts(structure, world.positions(), exact.contacts);
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

TEST(Tour, GoesThroughEveryStepByMouse) {
  PanelRig rig;
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
    if (step < last_step) rig.click("Next");
  }
  rig.click("Back");
  EXPECT_EQ(rig.ui.tour.step(), last_step - 1);
  rig.click("Close tour");
  EXPECT_FALSE(rig.ui.tour.open());
}

TEST(Tour, GoesThroughEveryStepByKeys) {
  PanelRig rig;
  const auto key = [&](int which) { handle_key(which, false, rig.session, rig.ui); };
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
    ASSERT_EQ(context->chosen, corner);
    const ui::HashedCorner& chosen = context->hashed_corner();
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
    for (std::size_t axis = 0; axis < 3; ++axis) sum += context->hashed_corner().cell[axis] * settings.primes[axis];
    const std::int64_t n = settings.buckets;
    EXPECT_EQ(((sum % n) + n) % n, context->hashed_corner().bucket);
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
  session.simulation.change_scene("Settings", [&](softbody::Scene& s) { s.collision = settings; });
  const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
  EXPECT_FALSE(found->missed.empty());
  session.settings.set_method("multi-level-sb");
  EXPECT_EQ(found->contacts.size() - found->missed.size(), session.world().detection().contacts.size());
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
  for (int i = 0; i < 4; ++i) rig.ui.tour.next();
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.run_ahead.active(); }));
  rig.frames(3);
  EXPECT_TRUE(rig.recorder.find("Contacts"));  // "none"
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
  Session session(shipped_scene("drop"), {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown);
  ASSERT_TRUE(tour.running_to(session));
  session.advance(tick);
  EXPECT_GT(session.world().frame(), 1) << "several frames per picture";
  tour.update(session);
  EXPECT_FALSE(tour.context(session));
  EXPECT_EQ(tour.highlight(), nullptr);
  int before = 0;
  for (; session.run_ahead.active(); session.advance(tick)) before = session.world().frame();
  tour.update(session);
  ASSERT_TRUE(tour.context(session));
  EXPECT_TRUE(tour.context(session)->f.touching);
  EXPECT_TRUE(session.simulation.clock.paused);
  EXPECT_LE(session.world().frame(), before + session::SimulationClock::max_steps);
  tour.close(session, shown);
  EXPECT_FALSE(session.simulation.clock.paused) << "the world goes on from there";
}

TEST(Tour, StaysInAFrameWithAContact) {
  Session session(touching_pair(), {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown);
  EXPECT_FALSE(tour.running_to(session));
  EXPECT_TRUE(session.simulation.clock.paused);
  EXPECT_EQ(session.world().frame(), 0);
}

TEST(Tour, RunsAheadInAnEmptyWorld) {
  softbody::Scene scene = falling_pair();
  for (softbody::BodySource& body : scene.bodies) body.appear = 20;
  Session session(scene, {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown);
  finish_run(session, tour);
  ASSERT_TRUE(tour.context(session));
  EXPECT_TRUE(tour.context(session)->f.touching);
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
  Session session(scene, {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown);
  finish_run(session, tour);
  EXPECT_NEAR(session.world().last_step().time, 20, 0.1);
  EXPECT_TRUE(tour.has_given_up(session));
  EXPECT_TRUE(tour.context(session));
  while (tour.step() < ui::miss_step) tour.next();
  EXPECT_FALSE(tour.has_given_up(session)) << "a page with another goal";
  tour.back();
  EXPECT_TRUE(tour.has_given_up(session));
  session.simulation.clock.single_step();
  session.advance(tick);
  EXPECT_FALSE(tour.has_given_up(session)) << "another frame";
}

TEST(Tour, ExplainsAMissOfThePapersMethod) {
  softbody::Scene scene = shipped_scene("drop");
  scene.collision.levels = 4;
  Session session(scene, {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown, ui::miss_step);
  finish_run(session, tour);
  ASSERT_EQ(tour.step(), ui::miss_step);
  ASSERT_TRUE(tour.context(session));
  const ui::TourExample& example = tour.context(session)->f;
  ASSERT_TRUE(example.miss);
  const ui::ExplainedMiss& miss = *example.miss;
  const std::vector<collide::Contact> misses = misses_of(session.world());
  EXPECT_EQ(example.all_missed, misses.size());
  EXPECT_TRUE(std::ranges::count(misses, miss.contact));
  EXPECT_NE(miss.corners[0].bucket, miss.corners[1].bucket);
  ASSERT_TRUE(miss.face);
  const int axis = miss.face->axis;
  const float at = static_cast<float>(miss.face->index) * (*session.world().collision().cell_size)[axis];
  std::array boxes{example.structure.boxes[miss.boxes[0]], example.structure.boxes[miss.boxes[1]]};
  if (boxes[0].lo[axis] > boxes[1].lo[axis]) std::swap(boxes[0], boxes[1]);
  EXPECT_LT(boxes[0].hi[axis], at);
  EXPECT_GE(boxes[1].lo[axis], at);
  const std::string text = ui::tour_steps()[ui::miss_step].text(*tour.context(session));
  EXPECT_NE(text.find("a cell face (dark blue) lies between"), std::string::npos) << text;
}

TEST(Tour, FramesTheBoxesOfAMissAndNotTheirCells) {
  softbody::Scene scene = touching_pair();
  scene.collision.cell_size = glm::vec3{2.47f, 60, 60};  // a face at x = 0, between the bodies
  Session session(scene, {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown, ui::miss_step);
  tour.update(session);
  ASSERT_TRUE(tour.context(session));
  ASSERT_TRUE(tour.context(session)->f.miss && tour.context(session)->f.miss->face);
  const render::Highlight& highlight = *tour.highlight();
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
  Session session(scene, {}, 1);
  ui::Tour tour;
  render::Overlays shown;
  tour.start(session, shown, 3);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    tour.choose_corner(corner);
    tour.update(session);
    const auto context = tour.context(session);
    const compare::BucketContents bucket = context->bucket();
    ASSERT_GT(bucket.groups.size(), 3u);
    EXPECT_EQ(bucket.groups.front().cell, context->bucket_corner().cell);
    const std::vector<ui::TourFigure> figures = ui::tour_steps()[3].figures(*context);
    EXPECT_EQ(figures[1].colour, render::same_cell_colour);
    EXPECT_EQ(figures[2].colour, render::aliased_colour);
    EXPECT_EQ(figures[4].value, grouped(bucket.groups.size() - 3)) << figures[4].label;
    EXPECT_EQ(tour.highlight()->labels.size(), 3u);
    EXPECT_EQ(tour.highlight()->boxes.size(), 2u) << "a set of cells and one of boxes";
  }
}

TEST(Tour, ShowsTheCellThatALargeBoxSkips) {
  softbody::Scene scene = touching_pair();
  scene.collision.levels = 0;
  scene.collision.cell_size = glm::vec3(0.3f);
  scene.collision.buckets = 1'000'003;
  scene.bodies[1].position = scene.bodies[0].position + glm::dvec3(0.57);  // the boxes overlap
  Session session(scene, {}, 1);
  const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
  ASSERT_TRUE(found && found->miss);
  const ui::ExplainedMiss& miss = *found->miss;
  ASSERT_TRUE(miss.skipped && !miss.face);
  const collide::methods::CellHash hash(session.world().collision());
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
  const ui::FrameWork of_drop_3000{.bodies = 3125,
                                   .vertices = 506'250,
                                   .boxes = 25'000,
                                   .hashes = 200'000,
                                   .pair_tests = 405'190'390,
                                   .all_pairs = 128'144'278'125,
                                   .pair_tests_estimated = true};
  for (const glm::ivec2 size : {glm::ivec2(640, 480), glm::ivec2(800, 500), glm::ivec2(1280, 720)}) {
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
      for (const char* label : {"Back", "Next", "Close tour"})
        EXPECT_LE(rig.widget(label).max.y, static_cast<float>(size.y)) << label;
    }
    rig.ui.tour.close(rig.session, rig.ui.overlays);
  }
}

TEST(Tour, SpeaksOfAliasingOnlyWhereItShowsIt) {
  for (const std::uint32_t buckets : {7u, 1'000'003u}) {
    softbody::Scene scene = touching_pair();
    scene.collision.buckets = buckets;
    Session session(scene, {}, 1);
    ui::Tour tour;
    render::Overlays shown;
    tour.start(session, shown);
    tour.update(session);
    const auto context = tour.context(session);
    const bool aliased = context->f.table.bucket(context->bucket_corner().bucket).groups.size() > 1;
    EXPECT_EQ(aliased, buckets == 7);
    const std::string text = ui::tour_steps()[3].text(*context);
    EXPECT_EQ(text.find("orange") != std::string::npos, aliased) << text;
  }
}

TEST(Tour, FindsAliasingInAnotherBox) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].position.x -= 0.2;
  for (std::uint32_t buckets = 30; buckets < 400; ++buckets) {
    scene.collision.buckets = buckets;
    Session session(scene, {}, 1);
    const auto found = ui::ExampleFinder().find(session.world(), std::nullopt);
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
        EXPECT_EQ(missed_by(found->structure, session.world()), expected) << levels << ' ' << cell;
        EXPECT_EQ(found->all_missed, expected.size());
        EXPECT_EQ(ui::ExampleFinder().has_miss(session.world()), !expected.empty());
        missed += expected.size();
      }
    }
  }
  EXPECT_GT(missed, 0u);
}

TEST(BodySubset, HasTheWorldsPositionsAndIndices) {
  Session session(touching_pair(), {}, 1);
  const collide::Frame all = session.world().positions();
  const ui::BodySubset second(session.world(), 1, 1);
  ASSERT_EQ(second.frame().x.size(), all.bodies->size(1));
  EXPECT_EQ(second.frame().x[5], all.x[all.bodies->first[1] + 5]);
  EXPECT_EQ(second.to_world({3, 4}).b, all.bodies->first[1] + 4);
}

}  // namespace THIS_FILE
}  // namespace app
