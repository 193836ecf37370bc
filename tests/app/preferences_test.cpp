#include <gtest/gtest.h>
#include <stdlib.h>

#include "app/session/system_files.h"
#include "app/window/preferences.h"
#include "tests/app/scenes.h"
#include "tests/full_disk.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using tests::TemporaryFolder;

/// Returns preferences that all differ from the defaults. The structured binding does not compile if one is missing.
window::Preferences changed() {
  window::Preferences p;
  auto& [size, shown, with_panel, slow_factor, methods] = p;
  auto& [overlays, panel, lights, hash_table, story, lower, sections] = shown;
  size = {900, 700};
  for (const render::OverlayRow& row : render::overlay_table) overlays.*row.shown = true;
  panel = lights = hash_table = story = false;
  lower = ui::LowerView::sweep;
  with_panel = true;
  slow_factor = 0.5;
  sections = {{"Detection", false}, {"A \"new\" one", true}};
  methods.flip();
  return p;
}

TEST(PreferencesFile, StoresEveryPreference) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a" / "b" / "preferences.toml";
  window::PreferencesFile first(file);
  EXPECT_TRUE(first.stored() == window::Preferences());
  EXPECT_EQ(first.store(changed(), 0, true), "");
  EXPECT_TRUE(window::PreferencesFile(file).stored() == changed());
}

TEST(PreferencesFile, WritesOnceNothingHasChangedForAWhile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "preferences.toml";
  window::PreferencesFile preferences(file);
  preferences.store(window::Preferences(), 0);
  preferences.store(window::Preferences(), 100);
  EXPECT_FALSE(std::filesystem::exists(file)) << "nothing to store";
  preferences.store(changed(), 100);
  preferences.store(changed(), 101);
  EXPECT_FALSE(std::filesystem::exists(file));
  preferences.store(changed(), 103);
  EXPECT_TRUE(window::PreferencesFile(file).stored() == changed());
}

TEST(PreferencesFile, IgnoresABrokenFileAndSaysSo) {
  const TemporaryFolder folder;
  for (const std::string text :
       {"width = \"wide\"", "width = 7", "= [", "[show]\nboxes = 3", "section = 1", "\xff\xfe"}) {
    window::PreferencesFile preferences(folder.write("preferences.toml", text));
    EXPECT_TRUE(preferences.stored() == window::Preferences()) << text;
    EXPECT_NE(preferences.store({}, 0).find("ignored"), std::string::npos) << text;
    EXPECT_EQ(preferences.store(changed(), 0, true), "") << "reported once";
    EXPECT_TRUE(window::PreferencesFile(folder.path() / "preferences.toml").stored() == changed());
  }
}

TEST(Preferences, OpenLessAtTheFirstStartWhereSpaceIsShort) {
  const ui::Remembered small = window::first_preferences({640, 480}).shown,
                       large = window::first_preferences({1600, 1000}).shown;
  EXPECT_FALSE(small.panel || small.lights || small.hash_table);
  EXPECT_TRUE(large.panel && large.lights && large.hash_table);
  const ui::Remembered usual = window::first_preferences(window::Preferences().size).shown;
  EXPECT_TRUE(usual.panel && usual.lights && usual.story_at_start);
  EXPECT_FALSE(usual.hash_table);
}

TEST(PreferencesFile, IgnoresUnknownKeys) {
  const TemporaryFolder folder;
  EXPECT_TRUE(window::PreferencesFile(folder.path() / "preferences.toml").is_new());
  window::PreferencesFile preferences(folder.write(
      "preferences.toml", "width = 500\ncolour = \"red\"\n[show]\nghosts = true\n[methods]\noracle = true\n"));
  EXPECT_FALSE(preferences.is_new());
  EXPECT_EQ(preferences.stored().size.x, 500);
  EXPECT_EQ(preferences.store(preferences.stored(), 0), "");
}

TEST(PreferencesFile, ReportsOnceThatItCannotBeWritten) {
  const TemporaryFolder folder;
  window::PreferencesFile preferences(folder.write("in the way", "") / "preferences.toml");
  EXPECT_NE(preferences.store(changed(), 0, true).find("cannot be kept"), std::string::npos);
  EXPECT_EQ(preferences.store(changed(), 10, true), "");
  const auto file = folder.write("preferences.toml", "panel = false\n");
  window::PreferencesFile kept(file);
  {
    const tests::FullDisk full(16);  // bytes
    EXPECT_NE(kept.store(changed(), 0, true).find("cannot be written"), std::string::npos);
  }
  const window::Preferences after = window::PreferencesFile(file).stored();
  EXPECT_TRUE(!after.shown.panel && after.slow_factor == window::Preferences().slow_factor) << "as they were";
}

TEST(Preferences, AreReadFromTheWindowAndAppliedToIt) {
  Session session(touching_pair(), {}, 1);
  ui::UiState ui;
  window::apply(changed(), session, ui);
  EXPECT_TRUE(window::preferences_of(session, ui, {900, 700}) == changed());
}

TEST(Preferences, AreInThePlatformsFolder) {
  const char* before = ::getenv("XDG_CONFIG_HOME");
  const std::string kept = before ? before : "";
  ::setenv("XDG_CONFIG_HOME", "/some/where", 1);
  EXPECT_EQ(session::preferences_path(), "/some/where/sbcollide/preferences.toml");
  ::setenv("XDG_CONFIG_HOME", "not/absolute", 1);
  EXPECT_EQ(session::preferences_path(),
            std::filesystem::path(::getenv("HOME")) / ".config/sbcollide/preferences.toml");
  before ? ::setenv("XDG_CONFIG_HOME", kept.c_str(), 1) : ::unsetenv("XDG_CONFIG_HOME");
}

}  // namespace THIS_FILE
}  // namespace app
