// The demo on a full disk: it reports the failure and goes on, and files saved before stay as they were.

#include "tests/full_disk.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/session/export/take_away.h"
#include "app/window/preferences.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace {

class FullDisk : public testing::Test {
 protected:
  static constexpr rlim_t too_little = 16;  // bytes

  /// Expects that the folder still has only this file, with this text.
  void expect_unchanged(const std::string& name, const std::string& text) {
    std::ostringstream now;
    now << std::ifstream(folder.path() / name).rdbuf();
    EXPECT_EQ(now.str(), text);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  }

  tests::TemporaryFolder folder;
  Session session{touching_pair(), {}, 1};
};

TEST_F(FullDisk, KeepsTheSceneThatWasSaved) {
  const auto file = folder.write("a.toml", "saved before");
  const tests::FullDisk full(too_little);
  session.save_scene(file, {});
  EXPECT_NE(session.notice().find("a.toml: cannot be written: File too large"), std::string::npos) << session.notice();
  EXPECT_EQ(session.scene_file().name(), "pair");
  expect_unchanged("a.toml", "saved before");
}

TEST_F(FullDisk, KeepsThePreferences) {
  const std::string saved = "panel = false\n";
  PreferencesFile file(folder.write("preferences.toml", saved));
  Preferences other;
  other.slow_factor = 0.5;
  const tests::FullDisk full(too_little);
  file.store(other, 0, true);
  EXPECT_NE(file.take_problem().find("cannot be written"), std::string::npos);
  expect_unchanged("preferences.toml", saved);
}

TEST_F(FullDisk, IsReportedForPicturesAndCurves) {
  folder.write("curves_0001.csv", "saved before");
  TakeAway take_away;
  take_away.folder = folder.path().string();
  const tests::FullDisk full(too_little);
  take_away.write_curves(session);
  EXPECT_TRUE(take_away.failed());
  EXPECT_NE(take_away.message().find("curves_0002.csv: cannot be written"), std::string::npos) << take_away.message();
  take_away.picture_asked = true;
  take_away.frame(session, [](bool) { return engine::Image{4, 4, std::vector<std::uint8_t>(64, 255)}; });
  EXPECT_TRUE(take_away.failed());
  EXPECT_NE(take_away.message().find("picture_0001.png: cannot be written"), std::string::npos) << take_away.message();
  expect_unchanged("curves_0001.csv", "saved before");
}

}  // namespace
}  // namespace app
