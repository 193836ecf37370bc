// The user's own methods in the window.

#include "app/session/live/guests.h"

#include "app/window/preferences.h"
#include "tests/app/panel_rig.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

std::string loop(const std::string& condition, const std::string& name = "Loop") {
  return "#include <sbcollide/method.h>\n"
         "static void find(void* self, const sbcollide_frame* f, float h, sbcollide_pairs* pairs) {\n"
         "  (void)self;\n"
         "  for (uint32_t a = 0; a < f->vertex_count; ++a)\n"
         "    for (uint32_t b = 0; b < a; ++b) {\n"
         "      float x = f->x[a] - f->x[b], y = f->y[a] - f->y[b], z = f->z[a] - f->z[b];\n"
         "      if (" +
         condition +
         ") sbcollide_add(pairs, a, b);\n"
         "    }\n"
         "}\n"
         "static const sbcollide_method m = {SBCOLLIDE_METHOD_VERSION, \"loop\", \"" +
         name + "\", \"All " + name +
         ".\", 0, find, 0};\n"
         "SBCOLLIDE_GUEST const sbcollide_method* sbcollide_guest(void) { return &m; }\n";
}
const std::string right = "x * x + y * y + z * z < h * h", false_one = "x * x < h * h", endless = "(b = 0)";

TEST(Guests, AreAskedForShownMendedAndComparedButDriveNothing) {
  const tests::TemporaryFolder folder;
  const auto write = [&](const std::string& condition) { return folder.write("loop.c", loop(condition)).string(); };
  PanelRig rig;
  session::Guests& guests = rig.session.guests;
  const std::vector<std::string> others = guests.take_from({"ball.obj", write("x *"), "scene.toml"});
  EXPECT_EQ(others, (std::vector<std::string>{"ball.obj", "scene.toml"}));
  rig.frames(3);
  EXPECT_TRUE(rig.shows("Guest report"));
  rig.click("Leave");
  EXPECT_FALSE(rig.shows("Guest report"));
  guests.take_from({write("x *")});
  rig.frames(3);
  const std::size_t before = collide::method_table().size();
  rig.click("Run");
  ASSERT_TRUE(rig.frames_until([&] { return rig.shows("Close guest report"); }));
  EXPECT_NE(guests.message().find("loop.c:7:"), std::string::npos) << guests.message();
  EXPECT_EQ(collide::method_table().size(), before) << "nobody knows its key yet";
  rig.click("Close guest report");
  EXPECT_FALSE(rig.shows("Guest report"));

  const session::LiveComparison& comparison = rig.session.comparison;
  const auto row = [&] { return comparison.scored_row(before); };
  const auto not_run = [&] {
    return comparison.report().rows.size() > before ? comparison.report().rows[before].not_run : std::string();
  };
  write(right);
  ASSERT_TRUE(rig.frames_until([&] { return row() != nullptr; }));
  EXPECT_EQ(collide::method_table()[before].key, "guest:loop");
  EXPECT_EQ(row()->recall, 1);
  EXPECT_EQ(row()->precision, 1);
  EXPECT_TRUE(row()->ms);
  const std::string driver = rig.session.world().method().key;
  rig.click("Drive Loop");
  EXPECT_EQ(rig.session.world().method().key, driver) << "it never drives bodies";

  const std::filesystem::path kept = folder.path() / "preferences.toml";
  window::PreferencesFile(kept).store(window::preferences_of(rig.session, rig.ui, {800, 600}), 0, true);
  window::PreferencesFile read(kept);
  EXPECT_EQ(read.store(read.stored(), 0, true), "") << "the key of a guest would be no key of TOML";

  folder.write("loop.c", loop(false_one, "k-d tree"));
  ASSERT_TRUE(rig.frames_until([&] { return row() && row()->precision < 1; }));
  EXPECT_EQ(collide::method_table()[before].name, "k-d tree 2");
  EXPECT_EQ(collide::method_table()[before].summary, "All k-d tree.");
  write(endless);
  ASSERT_TRUE(rig.frames_until([&] { return !not_run().empty(); }));
  EXPECT_EQ(not_run(), "not run: loop.c: over its time: 2 s");
  write(right);
  ASSERT_TRUE(rig.frames_until([&] { return row() && row()->precision == 1; }));
  EXPECT_EQ(comparison.sum(before).recall(), 1);
}

}  // namespace THIS_FILE
}  // namespace app
