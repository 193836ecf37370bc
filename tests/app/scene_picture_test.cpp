// The value by which the demo knows whether its picture of the scene is stale.

#include "app/window/scene_picture.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

class ScenePictureTest : public testing::Test {
 protected:
  window::ScenePicture now() const { return window::scene_picture(session, ui, camera, 1); }

  Session session{touching_pair(), {}, 1};
  ui::UiState ui;
  engine::Camera camera;
};

TEST_F(ScenePictureTest, StaysTheSameWhileNothingChangesThatItShows) {
  const window::ScenePicture before = now();
  EXPECT_TRUE(before == now());
  session.comparison.choice.misses_of = compare::method_index("octree");
  ui.help = true;
  EXPECT_TRUE(before == now()) << "no missed contacts are shown, and the help is no part of the scene";
}

TEST_F(ScenePictureTest, ChangesWithAllThatItShows) {
  const std::vector<std::function<void()>> changes{
      [&] { session.simulation.clock.single_step(), session.advance(tick); },
      [&] { session.bodies.select(1); },
      [&] { session.inspector.select_bucket(5); },
      [&] { ui.overlays.contacts = true; },
      [&] { ui.overlays.missed = true; },
      [&] { session.comparison.choice.misses_of = compare::method_index("octree"); },
      [&] { session.simulation.grab({.body = 0}); },
      [&] { toggle_beside(session.simulation); },
      [&] { ui.line = 0.4f; },
      [&] { ui.beside_as_ghost = true; },
      [&] { ui.tour.start(session, ui.overlays), ui.tour.update(session); },
      [&] { camera.set_orbit({.distance = 7}); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const window::ScenePicture before = now();
    changes[i]();
    EXPECT_FALSE(before == now()) << i;
  }
}

}  // namespace THIS_FILE
}  // namespace app
