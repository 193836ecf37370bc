// The panel's section on the method and its settings.

#include <algorithm>
#include <functional>

#include "softbody/scene/scene_keys.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

TEST(DetectionPanel, ChoosesEveryMethodWhileTheWorldRuns) {
  PanelRig rig;
  for (const collide::Method& method : collide::method_table()) {
    rig.click("Method");
    rig.click(method.name);
    EXPECT_EQ(rig.session.world().method().key, method.key);
    rig.frames(5);
    EXPECT_TRUE(rig.session.simulation.notice.text().empty()) << rig.session.simulation.notice.text();
  }
}

TEST(DetectionPanel, ListsAllMethodsAndExplainsEachBesideTheList) {
  for (const glm::ivec2 size : {glm::ivec2(1000, 600), glm::ivec2(1280, 720)}) {
    PanelRig rig;
    rig.ui.lower = ui::LowerView::comparison;
    rig.resize(size.x, size.y);
    rig.click("Method");
    const ui::WidgetRecorder::Widget list = rig.widget("All methods");
    for (const collide::Method& method : collide::method_table()) {
      const ui::WidgetRecorder::Widget line = rig.widget(method.name);
      EXPECT_LE(line.max.y, static_cast<float>(size.y)) << method.key;
      rig.move(line.min.x + 40, 0.5f * (line.min.y + line.max.y));
      rig.frames(40);
      const ui::WidgetRecorder::Widget tip = rig.widget("Tooltip");
      EXPECT_TRUE(tip.min.x >= line.max.x || tip.max.y <= list.min.y) << method.key << " covers the list";
      EXPECT_LE(tip.max.y, static_cast<float>(size.y)) << method.key;
    }
  }
}

TEST(DetectionPanel, ChoosesEveryContactSurface) {
  PanelRig rig;
  const std::vector order{softbody::ContactSurface::surfaces, softbody::ContactSurface::vertices};
  for (const softbody::ContactSurface surface : order) {
    const auto& all = softbody::contact_surfaces;
    rig.click("Contact surface");
    rig.click(std::ranges::find(all, surface, &softbody::ContactSurfaceInfo::value)->name);
    EXPECT_EQ(rig.session.world().scene().contact_surface, surface);
    rig.open("Numbers");
    EXPECT_EQ(rig.shows("  surfaces of two bodies"), surface == softbody::ContactSurface::surfaces);
  }
}

TEST(DetectionPanel, HasTheSettingsOfOneHashTableAndSaysWhoseItIs) {
  PanelRig rig;
  const std::size_t paper = compare::method_index(collide::paper_method);
  const float buckets = rig.area("Buckets").min.y;
  for (const collide::Method& method : collide::method_table()) {
    rig.session.settings.set_method(method.key);
    rig.frames(2);
    EXPECT_EQ(rig.shows("Level"), method.uses_levels || !method.uses_hash) << method.key;
    EXPECT_EQ(rig.area("Buckets").min.y, buckets) << "nothing moves";
    for (const char* label : {"Buckets", "Cell size", "Tolerance"}) EXPECT_TRUE(rig.widget(label).enabled) << label;
    rig.hover("Hashing of");
    EXPECT_EQ(rig.recorder.tooltip.find("has no hash table") == std::string::npos, method.uses_hash) << method.key;
    if (method.uses_hash) continue;
    const bool compared = rig.frames_until([&] { return rig.session.comparison.scored_row(paper) != nullptr; });
    EXPECT_TRUE(compared) << method.key;
  }
}

TEST(DetectionPanel, DragsEverySliderToItsEnds) {
  PanelRig rig;
  rig.session.settings.set_method("multi-level-sb");
  rig.frames(2);
  const auto& settings = [&]() -> const collide::Settings& { return rig.session.world().collision(); };
  using namespace softbody::scene_key;
  struct Row {
    const char* label;
    double least, most;
    std::function<double()> value;
  };
  for (const auto& [label, least, most, value] :
       {Row{"Level", 0, collide::max_levels, [&] { return settings().levels; }},
        Row{"Cell size", cell_size.slider.least, cell_size.slider.most,
            [&] { return double{settings().cell_size->x}; }},
        Row{"Tolerance", tolerance.slider.least, tolerance.slider.most, [&] { return double{settings().tolerance}; }},
        Row{"Buckets", 1, collide::max_buckets, [&] { return settings().buckets; }}}) {
    rig.drag(label, 500);
    EXPECT_NEAR(value(), most, 1e-5) << label;
    rig.drag(label, -500);
    EXPECT_NEAR(value(), least, 1e-5) << label;
  }
  EXPECT_EQ(settings().cell_size->y, settings().cell_size->x);
  rig.open("Detection");
  for (const bool automatic : {true, false, true}) {
    rig.click("Automatic cell size");
    EXPECT_EQ(rig.session.world().scene().collision.cell_size.has_value(), !automatic);
  }
  rig.click("Self-collision");
  EXPECT_FALSE(settings().self_collision);
  rig.click("Restore settings");
  EXPECT_EQ(rig.session.world().method().key, collide::default_method);
  EXPECT_EQ(settings().levels, 3);
  EXPECT_FALSE(rig.session.world().scene().collision.cell_size);
}

TEST(DetectionPanel, TakesPrimesAndWarnsOfThoseThatSpoilTheHash) {
  PanelRig rig;
  rig.open("Detection");
  const auto& primes = [&]() -> const auto& { return rig.session.world().collision().primes; };
  ASSERT_FALSE(rig.recorder.find("Primes warning"));
  rig.type("x prime", "7");
  rig.type("y prime", "1001");  // the number of buckets
  rig.type("z prime", "4294967295");
  EXPECT_EQ(primes(), (std::array<std::uint32_t, 3>{7, 1001, 4294967295}));
  EXPECT_TRUE(rig.recorder.find("Primes warning"));
  EXPECT_TRUE(rig.recorder.find("Buckets warning"));
  rig.type("y prime", "0");
  EXPECT_EQ(primes()[1], 1u) << "the smallest allowed";
  rig.click("Default primes");
  EXPECT_EQ(primes(), collide::default_primes);
  EXPECT_FALSE(rig.recorder.find("Primes warning"));
}

}  // namespace THIS_FILE
}  // namespace app
