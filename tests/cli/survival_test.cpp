// Full disks and folders that cannot be written to: saved files stay complete.

#include <gtest/gtest.h>

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

}  // namespace THIS_FILE
}  // namespace cli::test
