// `new-method`: a detector to begin with; and the examples of detectors of one's own, as guests.

#include <gtest/gtest.h>

#include "tests/cli/detect_rig.h"

namespace cli::test {
namespace THIS_FILE {

TEST(NewMethod, WritesTheDoubleLoopOfTheExamples) {
  const TemporaryFolder folder;
  for (const char* name : {"mine.c", "mine.cpp"}) {
    const Outcome o = run({"new-method", name}, folder.path());
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_NE(o.out.find(std::string("sbcollide --guest ") + name), std::string::npos) << o.out;
    EXPECT_EQ(read_file(folder.path() / name), read_file(SBCOLLIDE_GUESTS "/double_loop.c"));
  }
}

TEST(NewMethod, NeverWritesOverAFile) {
  const TemporaryFolder folder;
  const std::string mine = folder.write("mine.c", ""), nowhere = folder.path() / "link.c";
  std::filesystem::create_symlink("nowhere", nowhere);
  std::filesystem::create_directory(folder.path() / "folder.c");
  for (const std::string& taken : {mine, nowhere, (folder.path() / "folder.c").string()})
    expect_refused({"new-method", taken}, {taken, "name a new file"});
  EXPECT_EQ(read_file(mine), "");
  EXPECT_TRUE(std::filesystem::is_symlink(nowhere));
}

TEST(NewMethod, RefusesOtherKindsOfFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"mine", "mine.py", "mine.h", ".c", "no/folder/mine.py"})
    expect_refused({"new-method", folder.path() / name}, {name, ".c or .cpp"});
  expect_refused({"new-method", folder.path() / "no/folder/mine.c"}, {"no/folder/mine.c"});
  expect_refused({"new-method"}, {"FILE"});
  EXPECT_TRUE(file_names(folder.path()).empty());
}

using GuestExamplesInDetect = DetectFolder;

TEST_F(GuestExamplesInDetect, FindAllContactsButForTheMistake) {
  const State first = random_state(3), second = moved(first, 0.05f, 4);
  Words all{file("1.obj", first), file("2.obj", second), "--tolerance", "0.07", "--method", "all"};
  for (const char* name : {"double_loop.c", "hash_grid.c", "one_cell.c"})
    all = with(all, {"--guest", SBCOLLIDE_GUESTS "/" + std::string(name)});
  std::size_t guests = 0;
  for (const nlohmann::json& document : detect(all)) {
    if (!document["method"].get<std::string>().starts_with("guest:")) continue;
    ++guests;
    const bool mistaken = document["method"] == "guest:my-mistake";
    EXPECT_EQ(document["recall"] == 1.0, !mistaken) << document;
    EXPECT_EQ(document["precision"], 1.0);
    EXPECT_EQ(document["first_missed"].is_null(), !mistaken);
    EXPECT_TRUE(document["first_false"].is_null());
  }
  EXPECT_EQ(guests, 3u);
}

}  // namespace THIS_FILE
}  // namespace cli::test
