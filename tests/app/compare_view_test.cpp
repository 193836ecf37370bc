#include <algorithm>
#include <optional>

#include "app/window/scene_mouse.h"
#include "app/window/scene_picture.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"
#include "tests/own_process.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

/// Runs frames until the rows of a report meet the condition.
template <class Condition>
bool wait_until(PanelRig& rig, const Condition& condition) {
  return rig.frames_until([&] {
    const compare::CompareReport& report = rig.session.comparison.report();
    return !report.rows.empty() && condition(report.rows);
  });
}

/// True if these methods were timed and no others. Brute force is the reference.
bool only_timed(const std::vector<compare::CompareRow>& rows, const compare::MethodSet& methods) {
  for (std::size_t m = 0; m < rows.size(); ++m)
    if (rows[m].ms.has_value() != (methods[m] && collide::method_table()[m].key != "brute-force")) return false;
  return true;
}

bool usual_timed(const std::vector<compare::CompareRow>& rows) { return only_timed(rows, compare::usual_methods()); }

/// Expects rows of these methods and of no others.
void expect_rows(const PanelRig& rig, const compare::MethodSet& methods) {
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::string name(collide::method_table()[m].name);
    EXPECT_EQ(rig.recorder.find("Drive " + name) != nullptr, methods[m]) << name;
  }
}

TEST(CompareView, MeasuresOnlyTheDriverAndTheReferenceWhileItIsClosed) {
  PanelRig rig;
  rig.ui.panel = false;  // it shows the paper's method beside a driver without a hash table
  const auto scored = [](const auto& rows) { return std::ranges::count(rows, true, &compare::CompareRow::scored); };
  EXPECT_TRUE(wait_until(rig, [&](const auto& rows) { return scored(rows) == 2; }));
}

TEST(CompareView, MakesTheClickedMethodTheDriver) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  rig.session.comparison.choice.methods = compare::all_methods();
  rig.frames(3);
  for (const collide::Method& method : collide::method_table()) {
    rig.click("Drive " + std::string(method.name));
    EXPECT_EQ(rig.session.world().method().key, method.key);
  }
}

void expect_that_a_new_method_is_compared() {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  ASSERT_TRUE(wait_until(rig, usual_timed));
  const std::size_t before = collide::method_table().size();
  collide::Method row = *collide::find_method("sorted-grid");
  row.key = "one-more";
  row.name = "One more";
  collide::add_method(row);
  const auto is_timed = [=](const auto& rows) {
    return rows.size() > before && rows[before].ms && rows[before].recall == 1;
  };
  ASSERT_TRUE(wait_until(rig, is_timed));
  expect_rows(rig, compare::usual_methods());
  EXPECT_TRUE(session::curves_csv(rig.session.simulation, rig.session.comparison).find(",one-more_ms\n") !=
              std::string::npos);
  const compare::MethodSet shown = rig.session.comparison.shown_methods();
  EXPECT_EQ(compare::sweep_configurations(rig.session.world(), shown).back().method, before);
  rig.session.comparison.choice.methods.assign(before + 1, false);
  handle_key(GLFW_KEY_M, false, rig.session, rig.ui);  // no method to go to
  rig.session.comparison.choice.methods[before] = true;
  handle_key(GLFW_KEY_M, false, rig.session, rig.ui);
  EXPECT_EQ(rig.session.world().method().key, "one-more");
}

TEST(CompareView, TakesInAMethodThatJoinsTheTable) {
  tests::in_a_process_of_its_own(expect_that_a_new_method_is_compared);
}

TEST(CompareView, ShowsAndMeasuresTheMethodsAndGroupsThatAreChosen) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  compare::MethodSet expected = compare::usual_methods();
  const auto click = [&](std::string_view box, const auto& chosen) {
    rig.click(box);
    for (std::size_t m = 0; m < expected.size(); ++m)
      if (const std::optional<bool> shown = chosen(collide::method_table()[m])) expected[m] = *shown;
    EXPECT_EQ(rig.session.comparison.choice.methods, expected) << box;
    expect_rows(rig, expected);
    EXPECT_TRUE(wait_until(rig, [&](const auto& rows) { return only_timed(rows, expected); })) << box;
  };
  rig.frames(3);
  rig.click("Shown methods");
  click("Show Grid Hash",
        [](const collide::Method& method) { return method.key == "grid-hash" ? std::optional(false) : std::nullopt; });
  for (const collide::MethodGroupName& group : std::span(collide::method_groups).first(4))  // no guest is there
    click(group.name, [&](const collide::Method& method) {
      return method.group == group.group ? std::optional(true) : std::nullopt;
    });
  EXPECT_EQ(expected, compare::all_methods());
  click("Trees", [](const collide::Method& method) {
    return method.group == collide::MethodGroup::trees ? std::optional(false) : std::nullopt;
  });
  click("All methods", [](const collide::Method&) { return std::optional(true); });
  rig.press_escape();
  EXPECT_EQ(rig.recorder.find("All methods"), nullptr);
}

TEST(CompareView, AlwaysShowsAndMeasuresTheDriver) {
  PanelRig rig;
  rig.ui.panel = false;  // which says what the paper's method misses
  rig.ui.lower = ui::LowerView::comparison;
  rig.session.comparison.choice.methods.assign(collide::method_table().size(), false);
  rig.session.settings.set_method("octree");
  compare::MethodSet driver(collide::method_table().size(), false);
  driver[compare::method_index("octree")] = true;
  ASSERT_TRUE(wait_until(rig, [&](const auto& rows) { return only_timed(rows, driver); }));
  rig.frames(2);
  expect_rows(rig, driver);
}

TEST(CompareView, ScrollsWhereTheMethodsHaveNoRoom) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  rig.session.comparison.choice.methods = compare::all_methods();
  rig.resize(900, 500);
  EXPECT_FALSE(rig.recorder.find("No room"));
  EXPECT_GE(rig.interface.scene_area().max.y - rig.interface.scene_area().min.y, 200);
  EXPECT_LE(rig.widget("Drive Grid Hash").max.y, 500);
  EXPECT_GT(rig.widget("Drive Octree").max.y, 500);
}

TEST(CompareView, ShowsWhatTheChosenMethodMisses) {
  PanelRig rig;
  rig.session.simulation.clock.paused = true;
  rig.change([](softbody::Scene& scene) {
    scene.collision.cell_size = glm::vec3(0.13f);
    scene.collision.buckets = 1'000'003;
  });
  rig.ui.lower = ui::LowerView::comparison;
  const std::size_t literal = compare::method_index("multi-level-sb");
  ASSERT_TRUE(wait_until(rig, [&](const auto& rows) { return rows[literal].scored && rows[literal].recall < 1; }));
  ASSERT_NE(rig.session.comparison.missed(), nullptr);
  EXPECT_FALSE(rig.session.comparison.missed()->empty()) << "the paper's method, unless another one is chosen";
  EXPECT_FALSE(rig.ui.overlays.missed);
  rig.click("Misses of Grid Hash");
  EXPECT_TRUE(rig.ui.overlays.missed);
  const std::size_t grid = compare::method_index("grid-hash");
  ASSERT_TRUE(wait_until(rig, [&](const auto& rows) { return rows[grid].scored; }));
  EXPECT_TRUE(rig.session.comparison.missed()->empty()) << "it is exact";
}

TEST(CompareView, LetsTheWindowLookAtTheFirstMissedPair) {
  PanelRig rig;
  rig.session.simulation.clock.paused = true;
  rig.change([](softbody::Scene& scene) {
    scene.collision.cell_size = glm::vec3(0.13f);
    scene.collision.buckets = 1'000'003;
  });
  rig.ui.lower = ui::LowerView::comparison;
  const std::size_t literal = compare::method_index("multi-level-sb");
  ASSERT_TRUE(wait_until(rig, [&](const auto& rows) { return usual_timed(rows) && rows[literal].recall < 1; }));
  rig.frames(2);
  rig.session.comparison.choice.misses_of = compare::method_index("grid-hash");
  rig.click("Recall of Grid Hash");
  EXPECT_FALSE(rig.ui.once_compared) << "it misses nothing";
  rig.click("Recall of " + std::string(collide::method_table()[literal].name));
  EXPECT_TRUE(rig.ui.overlays.missed);
  EXPECT_EQ(rig.session.comparison.choice.misses_of, literal);
  ASSERT_TRUE(rig.frames_until([&] { return std::ranges::count(rig.tasks, ui::WindowTask::show_first_missed) > 0; }));
  const compare::CompareReport& report = rig.session.comparison.report();
  const collide::Contact pair = report.rows[literal].missed.at(0);
  engine::Camera camera;
  camera.set_orbit({.azimuth = -1.57f, .elevation = 0});  // from the left, where a body is 1 m deep before the pair
  window::focus_on(pair, rig.session, camera, {1280, 720});
  camera.finish_glide();
  const engine::Ray ray{camera.eye(), glm::normalize(camera.orbit().target - camera.eye())};
  const auto hidden_at =
      render::distance_to_scene(ray, rig.session.world(), window::positions_under_mouse(rig.session));
  EXPECT_GT(hidden_at.value_or(camera.orbit().distance), camera.orbit().distance - 0.8f) << "one looks between them";
  const collide::Frame frame = rig.session.world().positions();
  const glm::vec3 a = position(frame, pair.a), b = position(frame, pair.b);
  EXPECT_LT(glm::distance(camera.orbit().target, 0.5f * (a + b)), 1e-5f);
  EXPECT_FLOAT_EQ(report.rows[literal].missed_distance, glm::distance(a, b));

  rig.ui.once_compared = ui::WindowTask::show_first_missed;
  rig.session.simulation.clock.paused = false;
  rig.frames(1);
  EXPECT_FALSE(rig.ui.once_compared) << "the frame is gone";
}

TEST(CompareView, ShowsThePrecisionOnlyIfSomeContactIsFalse) {
  const auto guest = [] {
    collide::Method row = *collide::find_method("sorted-grid");
    row.key = row.name = "generous";
    row.make = [] {
      struct Generous : collide::Detector {
        void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers& workers,
                    collide::Result& result) override {
          collide::Settings wide = settings;
          wide.tolerance *= 2;
          of->detect(frame, wide, workers, result);
        }
        std::unique_ptr<collide::Detector> of = collide::find_method("sorted-grid")->make();
      };
      return std::make_unique<Generous>();
    };
    PanelRig rig;
    rig.session.simulation.clock.paused = true;
    rig.ui.lower = ui::LowerView::comparison;
    ASSERT_TRUE(wait_until(rig, usual_timed));
    rig.frames(2);
    EXPECT_FALSE(rig.shows("Column Precision"));
    EXPECT_TRUE(rig.shows("Column Since start"));
    collide::add_method(row);
    ASSERT_TRUE(wait_until(rig, [](const auto& rows) { return rows.back().scored && rows.back().precision < 1; }));
    rig.frames(2);
    EXPECT_TRUE(rig.shows("Column Precision"));
    rig.session.simulation.clock.paused = false;  // the bodies hardly move in the frames of a click
    rig.click("Precision of generous");
    EXPECT_TRUE(rig.session.simulation.clock.paused);
    ASSERT_TRUE(rig.frames_until([&] { return std::ranges::count(rig.tasks, ui::WindowTask::show_first_false) > 0; }));
    const compare::CompareReport& report = rig.session.comparison.report();
    EXPECT_EQ(report.id, rig.session.simulation.revision()) << "the frame in which the world stopped";
    const compare::CompareRow& found = report.rows.back();
    ASSERT_TRUE(found.first_false);
    EXPECT_GE(found.false_distance, rig.session.world().collision().tolerance);
    const window::ScenePicture picture = window::scene_picture(rig.session, rig.ui, {}, 1);
    const auto labels = window::scene_labels(rig.session, rig.ui.tour, picture, session::Half::first);
    EXPECT_EQ(std::ranges::count(labels, "a false pair", &render::SceneLabel::text), 1);
    EXPECT_EQ(window::overlay_request(rig.session, rig.ui.tour, picture, session::Half::first).false_found,
              found.first_false);
  };
  tests::in_a_process_of_its_own(guest);
}

TEST(CompareView, KeepsEverythingInPlaceWhileItMeasures) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    rig.ui.lower = ui::LowerView::comparison;
    rig.frames(3);
    const auto before = rig.recorder.widgets;
    ASSERT_TRUE(wait_until(rig, usual_timed));
    rig.frames(2);
    rig.expect_in_place(before, "Coverage");  // whose sentence changes
  }
}

}  // namespace THIS_FILE
}  // namespace app
