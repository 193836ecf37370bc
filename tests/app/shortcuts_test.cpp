#include "app/ui/state/shortcuts.h"

#include <gtest/gtest.h>

#include "tests/app/keys.h"
#include "tests/app/scenes.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

compare::MethodSet only(std::initializer_list<const char*> keys) {
  compare::MethodSet methods(collide::method_table().size(), false);
  for (const char* key : keys) methods[compare::method_index(key)] = true;
  return methods;
}

TEST(Shortcuts, ActAsTheHelpSays) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  const auto tap = [&](int key) { return handle_key(key, false, session, ui); };
  EXPECT_TRUE(tap(' '));
  EXPECT_TRUE(session.simulation.clock.paused);
  tap('N');
  session.advance(0);
  EXPECT_EQ(session.world().frame(), 1);
  tap('S');
  EXPECT_TRUE(session.simulation.clock.slow_motion);
  tap(']');
  EXPECT_EQ(session.world().collision().levels, 4);
  for (int i = 0; i < 20; ++i) tap('[');
  EXPECT_EQ(session.world().collision().levels, 0);
  for (const render::OverlayRow& row : render::overlay_table) {
    const bool before = ui.overlays.*row.shown;
    EXPECT_TRUE(tap(row.shortcut));
    EXPECT_NE(ui.overlays.*row.shown, before);
  }
  tap('H');
  EXPECT_FALSE(ui.panel);
  const auto task = [&](int key) { return std::get<ui::WindowTask>(*ui::request_by_key(session, key, false)); };
  EXPECT_TRUE(task('C') == ui::WindowTask::reset_camera);
  tap('?');
  EXPECT_TRUE(ui.help);
  EXPECT_TRUE(task('Q') == ui::WindowTask::quit);
  EXPECT_FALSE(tap('Z'));
  EXPECT_FALSE(tap('/')) << "only some keyboards have it on the key of ?";
}

TEST(Shortcuts, ShowTheCardInPlaceOfTheViewsBelowTheScene) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  for (const int key : {'V', 'E', 'W', 'V', 'W'}) {
    handle_key(key, false, session, ui);
    EXPECT_EQ(ui.shows_story(), key == 'W');
  }
  handle_key('W', false, session, ui);
  EXPECT_FALSE(ui.shows_story() || ui.story_at_start);
}

TEST(Shortcuts, SayWhatTheyDid) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  const auto said = [&](int key) {
    handle_key(key, false, session, ui);
    EXPECT_FALSE(session.simulation.notice.is_error());
    return session.simulation.notice.text();
  };
  EXPECT_EQ(said('F'), "Contact: Surface");
  EXPECT_EQ(session.world().scene().contact_surface, softbody::ContactSurface::surfaces);
  EXPECT_EQ(said('F'), "Contact: Vertex-vertex");
  session.comparison.choice.methods = only({"octree", "grid-hash"});
  for (const char* key : {"octree", "grid-hash", "octree"}) {
    EXPECT_EQ(said('M'), "Method: " + collide::find_method(key)->name);
    EXPECT_EQ(session.world().method().key, key);
  }
  softbody::Scene large = touching_pair();
  large.bodies.resize(1);
  large.bodies[0].mesh.subdivisions = 4;
  large.bodies.resize(18, large.bodies[0]);
  Session refusing(large, {}, 1);
  refusing.comparison.choice.methods = only({"brute-force"});
  handle_key('M', false, refusing, ui);
  EXPECT_TRUE(refusing.simulation.notice.is_error()) << "a refusal is not hidden";
}

TEST(Shortcuts, IgnoreKeysWithAltOrSuper) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  for (const int mod : {GLFW_MOD_ALT, GLFW_MOD_SUPER}) {
    for (const ui::Shortcut& shortcut : ui::shortcuts())
      EXPECT_FALSE(handle_key(shortcut.key, false, session, ui, shortcut.mods | mod)) << shortcut.keys_text;
    for (const render::OverlayRow& row : render::overlay_table)
      EXPECT_FALSE(handle_key(row.shortcut, false, session, ui, mod)) << row.label;
  }
  EXPECT_FALSE(ui.overlays.any());
}

TEST(Shortcuts, RepeatOnlySomeActionsOfAHeldKey) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  EXPECT_FALSE(handle_key(' ', true, session, ui));
  EXPECT_FALSE(handle_key('1', true, session, ui));
  EXPECT_TRUE(handle_key('N', true, session, ui));
}

TEST(Shortcuts, ActWithControlShiftAndDelete) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  session.bodies.select(0);
  EXPECT_TRUE(handle_key(GLFW_KEY_ESCAPE, false, session, ui));
  EXPECT_FALSE(session.bodies.selected());
  EXPECT_FALSE(handle_key('R', false, session, ui, GLFW_MOD_CONTROL)) << "it means something else in other programs";
  const auto request = ui::request_by_key(session, 'B', false);
  ASSERT_TRUE(request);
  EXPECT_TRUE(std::get<ui::WindowTask>(*request) == ui::WindowTask::throw_body);
  EXPECT_TRUE(std::get<ui::WindowTask>(*ui::request_by_key(session, 'K', false)) == ui::WindowTask::switch_hold);
  struct Row {
    int key, mods;
    std::size_t bodies;  // afterwards
  };
  for (const auto& [key, mods, bodies] :
       {Row{'D', 0, 3}, Row{'R', 0, 2}, Row{'D', GLFW_MOD_SHIFT, 22}, Row{GLFW_KEY_DELETE, 0, 21}, Row{'R', 0, 2},
        Row{'Z', GLFW_MOD_CONTROL, 21}, Row{'Z', GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, 2}, Row{'Z', GLFW_MOD_CONTROL, 21},
        Row{'Y', GLFW_MOD_CONTROL, 2}}) {
    if (key == GLFW_KEY_DELETE) session.bodies.select(3);
    EXPECT_TRUE(handle_key(key, false, session, ui, mods)) << key;
    EXPECT_EQ(session.world().bodies().count(), bodies) << key;
  }
}

}  // namespace THIS_FILE
}  // namespace app
