// Full disks, folders that cannot be written to, and a sudden end: saved files stay complete.

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/cli/process.h"
#include "tests/full_disk.h"

namespace cli::test {
namespace THIS_FILE {

namespace fs = std::filesystem;

/// A command that writes into a folder, and the file that it writes there first.
struct Writer {
  std::string name;
  Words arguments;  // the folder, or the file in it, comes last
  std::string file;
  bool names_file = false;             // the last argument is the file
  std::string saved = "saved before";  // what is there, which it may replace
};

std::vector<Writer> writers() {
  const std::string mesh = std::string(SBCOLLIDE_SCENES) + "/../meshes/star.obj";
  std::vector<Writer> list{
      {"objects", {"simulate", "--scene", "A", "--frames", "1", "--obj-every", "1", "--out"}, "rest_0001.obj"},
      {"contacts",
       {"detect", mesh, "--tolerance", "0.9", "--contacts"},
       "contacts.csv",
       true,
       "frame,vertex_a,vertex_b,body_a,body_b,distance\n"}};
  const Words pictures{"simulate", "--scene", "A", "--frames", "3", "--size", "64x64"};
  if (SBCOLLIDE_GRAPHICS) {
    list.push_back({"picture", with(pictures, {"--capture", "1", "--out"}), "frame_0001.png"});
    list.push_back({"animation", with(pictures, {"--animation"}), "run.webp", true, "RIFF, saved before"});
  }
  return list;
}

class Survival : public testing::TestWithParam<Writer> {
 protected:
  Outcome write_to(const fs::path& folder) const {
    return run(with(GetParam().arguments, {GetParam().names_file ? folder / GetParam().file : folder}));
  }
};

TEST_P(Survival, ReportsAFullDiskAndChangesNothing) {
  const TemporaryFolder folder;
  folder.write(GetParam().file, GetParam().saved);
  const tests::FullDisk full;
  const Outcome o = write_to(folder.path());
  EXPECT_EQ(o.status, 2) << o.err;
  EXPECT_NE(o.err.find(GetParam().file + ": cannot be written: "), std::string::npos) << o.err;
  EXPECT_EQ(read_file(folder.path() / GetParam().file), GetParam().saved);
  EXPECT_EQ(file_names(folder.path()), std::set<std::string>{GetParam().file}) << "nothing half written is left";
}

/// Not even root writes to /proc.
TEST_P(Survival, ReportsAFolderThatTakesNoFiles) {
  const Outcome o = write_to("/proc");
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("/proc"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("cannot be written"), std::string::npos) << o.err;
}

INSTANTIATE_TEST_SUITE_P(Writers, Survival, testing::ValuesIn(writers()),
                         [](const auto& writer) { return writer.param.name; });

/// The program is killed after it has replaced half of the saved files. Each file is the old or the new one, and each
/// new file is complete.
TEST(SuddenEnd, LeavesOnlyCompleteFiles) {
  const TemporaryFolder folder;
  std::set<std::string> saved;
  for (const int first : {10, 30})
    for (int frame = first; frame < first + 10; ++frame) saved.insert("frame_00" + std::to_string(frame) + ".obj");
  for (const std::string& name : saved) folder.write(name, "saved before");
  const std::string out = folder.path().string(),
                    script = "'" SBCOLLIDE_PROGRAM "' simulate --scene D --frames 100000 --obj-every 1 --out '" + out +
                             "' & child=$!; until [ -e '" + out +
                             "/frame_0025.obj' ]; do kill -0 $child || exit 1; done; kill -9 $child";
  ASSERT_EQ(std::system(("{ " + script + "; } 2>/dev/null").c_str()), 0);
  int fresh = 0;
  for (const std::string& name : file_names(folder.path())) {
    if (!name.starts_with("frame_") || !name.ends_with(".obj")) continue;
    const std::string text = read_file(folder.path() / name);
    if (saved.erase(name) > 0 && text == "saved before") continue;
    const std::string last = text.substr(text.rfind("\nf ") + 1);
    EXPECT_TRUE(last.starts_with("f ") && last.ends_with('\n')) << name << " ends with: " << last;
    ++fresh;
  }
  EXPECT_TRUE(saved.empty()) << *saved.begin() << " is gone";
  EXPECT_GE(fresh, 25);
}

}  // namespace THIS_FILE
}  // namespace cli::test
