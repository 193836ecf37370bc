// The demo on a full disk: it reports the error, continues, and leaves saved files unchanged.

#include "tests/full_disk.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/session/session.h"
#include "app/window/preferences.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

class FullDisk : public testing::Test {
 protected:
  static constexpr rlim_t too_little = 16;  // bytes

  /// Expects that the folder holds this file alone, with the old text.
  void expect_unchanged(const std::string& name, const std::string& text) {
    std::ostringstream now;
    now << std::ifstream(folder.path() / name).rdbuf();
    EXPECT_EQ(now.str(), text);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  }

  tests::TemporaryFolder folder;
  Session session{touching_pair(), {}, 1};
};

TEST_F(FullDisk, LeavesASavedSceneUnchanged) {
  const auto file = folder.write("a.toml", "saved before");
  const tests::FullDisk full(too_little);
  const std::string problem = session.scenes.save(file, {});
  EXPECT_NE(problem.find("a.toml: cannot be written: File too large"), std::string::npos) << problem;
  EXPECT_EQ(session.simulation.loaded.file.name(), "pair");
  expect_unchanged("a.toml", "saved before");
}

TEST_F(FullDisk, LeavesThePreferencesUnchanged) {
  const std::string saved = "panel = false\n";
  window::PreferencesFile file(folder.write("preferences.toml", saved));
  window::Preferences other;
  other.slow_factor = 0.5;
  const tests::FullDisk full(too_little);
  EXPECT_NE(file.store(other, 0, true).find("cannot be written"), std::string::npos);
  expect_unchanged("preferences.toml", saved);
}

TEST_F(FullDisk, IsReportedForPicturesAndCurves) {
  folder.write("curves_0001.csv", "saved before");
  session::Exporter& exporter = session.exporter;
  exporter.folder = folder.path().string();
  const tests::FullDisk full(too_little);
  exporter.write_curves();
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("curves_0002.csv: cannot be written"), std::string::npos) << exporter.message();
  exporter.picture_requested = true;
  exporter.frame([](bool, const auto&) { return engine::Image{4, 4, std::vector<std::uint8_t>(64, 255)}; });
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("picture_0001.png: cannot be written"), std::string::npos) << exporter.message();
  expect_unchanged("curves_0001.csv", "saved before");
}

}  // namespace THIS_FILE
}  // namespace app
