// What --play refuses before it opens a window: status 2 and one line.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

TEST(Play, RefusesBadFilesAndWhatDoesNotGoWithThem) {
  if (!SBCOLLIDE_GRAPHICS) GTEST_SKIP() << "this build has no window";
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) { return folder.write(name, text).string(); };
  const std::string triangle = write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Words play{"--play", triangle};
  write("scene.toml", "[ground]\nfriction = -1\n");
  for (const auto& [arguments, says] : std::vector<std::pair<Words, Words>>{
           {{"--play"}, {"--play"}},
           {{"--play", "none.obj"}, {"none.obj", "cannot be"}},
           {{"--play", write("bad.obj", "v 0 0 zero\n")}, {"bad.obj:1", "zero"}},
           {{"--play", write("short.ply", "ply\nformat ascii 1.0\nelement vertex 2\n")}, {"short.ply"}},
           {{"--play", write("empty.obj", "")}, {"empty.obj"}},
           {with(play, {"--scene", "drop"}), {"--scene", "--play"}},
           {with({"--mesh", triangle}, play), {"--mesh", "--play"}},
           {with(play, {"--integrator", "xpbd"}), {"--integrator", "--play simulates nothing"}},
           {with(play, {"--substeps", "3"}), {"--substeps", "--play simulates nothing"}},
           {with(play, {"--contact-surface", "surface"}), {"--contact-surface", "--play"}},
           {with(play, {"--beside", "levels=3"}), {"--beside", "--play"}},
           {with(play, {"simulate", "--frames", "2"}), {"--play", "window"}},
           {with(play, {"--bodies", "parts"}), {"--bodies parts", "components"}},
           {{"--bodies", "one"}, {"--bodies", "--play"}},
           {{"--play", write("frame_1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}, {"scene.toml:2", "friction"}},
           {with(play, {"--tolerance", "-1"}), {"--tolerance"}},
           {with(play, {"--method", "magic"}), {"--method magic"}}})
    expect_refused(arguments, says);
}

}  // namespace THIS_FILE
}  // namespace cli::test
