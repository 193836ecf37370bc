// What --play refuses before it opens a window: status 2 and one line.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

class Play : public testing::Test {
 protected:
  void SetUp() override {
    if (!SBCOLLIDE_GRAPHICS) GTEST_SKIP() << "this build has no window";
  }
  std::string write(const std::string& name, const std::string& text) const {
    return folder.write(name, text).string();
  }

  const TemporaryFolder folder;
  const std::string triangle = write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
};

TEST_F(Play, RefusesFilesThatCannotBeFrames) {
  expect_refused({"--play"}, {"--play"});
  expect_refused({"--play", "none.obj"}, {"none.obj", "cannot be"});
  expect_refused({"--play", write("bad.obj", "v 0 0 zero\n")}, {"bad.obj:1", "zero"});
  expect_refused({"--play", write("short.ply", "ply\nformat ascii 1.0\nelement vertex 2\n")}, {"short.ply"});
  expect_refused({"--play", write("empty.obj", "")}, {"empty.obj"});
}

TEST_F(Play, RefusesOptionsOfWhatIsSimulated) {
  expect_refused({"--play", triangle, "--scene", "drop"}, {"--scene", "--play"});
  expect_refused({"--mesh", triangle, "--play", triangle}, {"--mesh", "--play"});
  expect_refused({"--play", triangle, "--integrator", "xpbd"}, {"--integrator", "--play simulates nothing"});
  expect_refused({"--play", triangle, "--substeps", "3"}, {"--substeps", "--play simulates nothing"});
  expect_refused({"--play", triangle, "--contact-surface", "surface"}, {"--contact-surface", "--play"});
  expect_refused({"--play", triangle, "simulate", "--frames", "2"}, {"--play", "window"});
}

TEST_F(Play, RefusesBadSettings) {
  expect_refused({"--play", triangle, "--bodies", "parts"}, {"--bodies parts", "components"});
  expect_refused({"--bodies", "one"}, {"--bodies", "--play"});
  expect_refused({"--play", triangle, "--tolerance", "-1"}, {"--tolerance"});
  expect_refused({"--play", triangle, "--method", "magic"}, {"--method magic"});
}

}  // namespace THIS_FILE
}  // namespace cli::test
