// The panel's parts for bodies, gravity, materials and solids.

#include <glm/geometric.hpp>

#include "app/files/inputs.h"
#include "app/ui/parts.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/mechanics/material_keys.h"
#include "softbody/world/measures.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

TEST(BodiesPanel, DropsThrowsDeletesAndUndoes) {
  PanelRig rig;
  rig.open("Bodies");
  EXPECT_FALSE(rig.widget("Undo").enabled);
  EXPECT_FALSE(rig.widget("Delete").enabled);
  const auto bodies = [&] { return rig.session.world().bodies().count(); };
  rig.click("Drop");
  EXPECT_EQ(bodies(), 3u);
  rig.click("Drop 20");
  EXPECT_EQ(bodies(), 23u);
  rig.click("Throw");
  EXPECT_EQ(rig.tasks, std::vector{ui::WindowTask::throw_body}) << "the main loop throws it from its camera";
  rig.session.bodies.select(1);
  rig.frames(2);
  rig.click("Look at it");
  EXPECT_TRUE(rig.tasks.back() == ui::WindowTask::show_selected_body);
  rig.click("Delete");
  EXPECT_EQ(bodies(), 22u);
  EXPECT_FALSE(rig.session.bodies.selected());
  rig.click("Reset");
  EXPECT_EQ(bodies(), 2u);
  EXPECT_FALSE(rig.widget("Redo").enabled);
  rig.click("Undo");
  EXPECT_EQ(bodies(), 22u);
  rig.click("Redo");
  EXPECT_EQ(bodies(), 2u);
  rig.drag("Throw speed", 500);
  EXPECT_NEAR(rig.session.bodies.throw_speed, session::BodyControls::max_throw_speed, 1e-5);
}

TEST(BodiesPanel, CountsTheBodiesToCome) {
  softbody::Scene scene = touching_pair();
  for (const int frame : {20, 21, 40}) {
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies.back().appear = frame;
    scene.bodies.back().position.y += 0.1 * frame;
  }
  PanelRig rig(1, scene);
  for (; rig.session.world().frame() < 60; rig.frame()) {
    const auto here = rig.session.world().bodies().count();
    EXPECT_EQ(ui::bodies_to_come(rig.session.world()), 5 - here) << rig.session.world().frame();
  }
}

TEST(WorldPanel, DragsEverySliderToItsEndsWhileTheWorldRuns) {
  PanelRig rig;
  rig.open("World");
  const softbody::World& world = *rig.session.simulated();
  std::vector<std::string> labels{"Gravity"};
  for (const softbody::Key* key : softbody::material_keys())
    if (key->slider.text) labels.emplace_back(key->name);
  for (const std::string& label : labels) {
    for (const float by : {500.0f, -500.0f}) {
      rig.drag(label.c_str(), by);
      rig.frames(5);
      EXPECT_FALSE(rig.session.simulation.clock.paused) << label << ": " << rig.session.simulation.notice.text();
      EXPECT_TRUE(softbody::measure(world).finite) << label;
    }
    rig.click("Restore world");
    EXPECT_EQ(world.scene().materials[0][softbody::Material::mass], 1) << label;
  }
  rig.drag("Gravity", -500);
  EXPECT_EQ(glm::length(world.scene().gravity), 0);
  EXPECT_FALSE(world.plan().has(softbody::Stage::gravity));
}

TEST(SolidsPanel, DragsEverySliderToItsEndsWhileTheWorldRuns) {
  PanelRig rig;
  rig.open("Solids");
  for (const char* label : {"Solid position", "Solid radius", "Solid friction", "Solid restitution"})
    for (const float by : {500.0f, -500.0f}) {
      rig.drag(label, by);
      rig.frames(5);
      EXPECT_FALSE(rig.session.simulation.clock.paused) << label << ": " << rig.session.simulation.notice.text();
      EXPECT_TRUE(softbody::measure(*rig.session.simulated()).finite) << label;
      rig.session.settings.restore_world();
    }
}

TEST(Slider, TakesATypedValueAfterADoubleClick) {
  PanelRig rig;
  rig.open("World");
  const auto gravity = [&] { return glm::length(rig.session.world().scene().gravity); };
  const double before = gravity();
  rig.click("Gravity");
  EXPECT_NE(gravity(), before) << "a click sets the value at its position";
  rig.click("Restore world");
  rig.double_click("Gravity");
  EXPECT_NEAR(gravity(), before, 1e-6) << "a double-click keeps the value";
  rig.type("3.5");
  EXPECT_NEAR(gravity(), 3.5, 1e-6);
  rig.double_click("Gravity");
  EXPECT_NEAR(gravity(), 3.5, 1e-6) << "in the open field";
  rig.double_click("bend.stiffness");
  EXPECT_NEAR(gravity(), 3.5, 1e-6) << "another slider";
}

TEST(WorldPanel, OffersThePresetsOfMaterials) {
  PanelRig rig(1, touching_pair(), files::scene_folder());
  rig.open("World");
  const auto& presets = rig.session.scenes.presets();
  ASSERT_GE(presets.size(), 4u);
  const softbody::Material& chosen = presets[1];
  rig.click("Material preset");
  rig.click(chosen.name.c_str());
  const softbody::Material& now = rig.session.world().scene().materials[0];
  EXPECT_EQ(now.name, "rubber") << "the material keeps its name";
  EXPECT_EQ(now[softbody::Material::mass], chosen[softbody::Material::mass]);
  EXPECT_EQ(now[softbody::StructuralSprings::stiffness], chosen[softbody::StructuralSprings::stiffness]);
  EXPECT_EQ(now[softbody::GasPressure::inside], chosen[softbody::GasPressure::inside]);
}

TEST(SolidsPanel, SwitchesAndChoosesSolids) {
  PanelRig rig;
  rig.open("Solids");
  rig.click("Solid enabled");
  EXPECT_FALSE(rig.session.world().scene().solids[0].enabled);
  EXPECT_FALSE(rig.widget("Solid radius").enabled);
  rig.click_each({"Solid", "Ground"});
  rig.frames(2);
  rig.drag("Ground height", 30);
  EXPECT_GT(shape_of<softbody::Ground>(rig.session.world().scene()).height, 0);
  EXPECT_FALSE(rig.session.world().scene().solids[0].enabled);
}

}  // namespace THIS_FILE
}  // namespace app
