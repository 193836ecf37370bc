// What is remembered from one start to the next.

#include <gtest/gtest.h>
#include <stdlib.h>

#include "app/window/preferences.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace {

using tests::TemporaryFolder;

/// All of them other than the defaults. Taken apart, so that a new one does not compile before it is tested.
Preferences other() {
  Preferences p;
  auto& [size, overlays, panel, table, sweep, compare, with_panel, slow_factor, sections] = p;
  size = {900, 700};
  for (const OverlayRow& row : overlay_table) overlays.*row.shown = true;
  panel = table = false;
  sweep = compare = with_panel = true;
  slow_factor = 0.5;
  sections = {{"Detection", false}, {"A \"new\" one", true}};
  return p;
}

TEST(PreferencesFile, KeepsAllOfThem) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a" / "b" / "preferences.toml";
  PreferencesFile first(file);
  EXPECT_TRUE(first.kept() == Preferences());
  first.keep(other(), 0, true);
  EXPECT_EQ(first.take_problem(), "");
  EXPECT_TRUE(PreferencesFile(file).kept() == other());
}

TEST(PreferencesFile, IsWrittenOnceTheyHaveSettled) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "preferences.toml";
  PreferencesFile preferences(file);
  preferences.keep(Preferences(), 0);
  preferences.keep(Preferences(), 100);
  EXPECT_FALSE(std::filesystem::exists(file)) << "nothing to keep";
  preferences.keep(other(), 100);
  preferences.keep(other(), 101);
  EXPECT_FALSE(std::filesystem::exists(file));
  preferences.keep(other(), 103);
  EXPECT_TRUE(PreferencesFile(file).kept() == other());
}

TEST(PreferencesFile, IsIgnoredWithANoticeIfItIsBroken) {
  const TemporaryFolder folder;
  for (const std::string text :
       {"width = \"wide\"", "width = 7", "= [", "[show]\nboxes = 3", "section = 1", "\xff\xfe"}) {
    PreferencesFile preferences(folder.write("preferences.toml", text));
    EXPECT_TRUE(preferences.kept() == Preferences()) << text;
    EXPECT_NE(preferences.take_problem().find("ignored"), std::string::npos) << text;
    EXPECT_EQ(preferences.take_problem(), "") << "told once";
    preferences.keep(other(), 0, true);
    EXPECT_TRUE(PreferencesFile(folder.path() / "preferences.toml").kept() == other());
  }
}

TEST(PreferencesFile, OfANewerProgramIsReadAsFarAsKnown) {
  const TemporaryFolder folder;
  PreferencesFile preferences(
      folder.write("preferences.toml", "width = 500\ncolour = \"red\"\n[show]\nghosts = true\n"));
  EXPECT_EQ(preferences.kept().size.x, 500);
  EXPECT_EQ(preferences.take_problem(), "");
}

TEST(PreferencesFile, SaysOnceThatItCannotBeWritten) {
  const TemporaryFolder folder;
  PreferencesFile preferences(folder.write("in the way", "") / "preferences.toml");
  preferences.keep(other(), 0, true);
  EXPECT_NE(preferences.take_problem().find("cannot be kept"), std::string::npos);
  preferences.keep(other(), 10, true);
  EXPECT_EQ(preferences.take_problem(), "");
}

TEST(Preferences, AreThoseOfTheWindowAndGoBackIntoIt) {
  Session session(touching_pair(), {}, 1);
  UiState ui;
  apply(other(), session, ui);
  EXPECT_TRUE(preferences_of(session, ui, {900, 700}) == other());
}

TEST(Preferences, LieInThePlatformsFolder) {
  const char* before = ::getenv("XDG_CONFIG_HOME");
  const std::string kept = before ? before : "";
  ::setenv("XDG_CONFIG_HOME", "/some/where", 1);
  EXPECT_EQ(preferences_path(), "/some/where/sbcollide/preferences.toml");
  ::setenv("XDG_CONFIG_HOME", "not/absolute", 1);
  EXPECT_EQ(preferences_path(), std::filesystem::path(::getenv("HOME")) / ".config/sbcollide/preferences.toml");
  before ? ::setenv("XDG_CONFIG_HOME", kept.c_str(), 1) : ::unsetenv("XDG_CONFIG_HOME");
}

}  // namespace
}  // namespace app
