// Files that become complete or do not change.

#include "app/files/output_file.h"

#include <gtest/gtest.h>

#include "app/base/usage_error.h"
#include "app/files/inputs.h"
#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

namespace fs = std::filesystem;

/// Returns why a file cannot be written there. Fails the test if it can be.
std::string refusal(const fs::path& path) {
  try {
    app::files::OutputFile file(path);
    file.write("new");
    file.commit();
  } catch (const app::UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << path << " was written";
  return "";
}

TEST(OutputFile, ReplacesTheOldFileOnCommitAndOnlyThen) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("file", "old"), ordinary = folder.write("ordinary", "x");
  for (const fs::path& each : {path, folder.path() / "other"}) app::files::OutputFile(each).write("new");
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"file", "ordinary"}));
  app::files::OutputFile file(path);
  file.write("ne");
  file.write("w");
  EXPECT_EQ(read_file(path), "old");
  file.commit();
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"file", "ordinary"}));
  EXPECT_EQ(fs::status(path).permissions(), fs::status(ordinary).permissions());
}

TEST(OutputFile, NeverReplacesAnInputUnderAnyNameOrLink) {
  const TemporaryFolder folder;
  const fs::path mesh = folder.write("mesh.obj", "v 0 0 0\n"), linked = folder.write("linked.obj", "v 1 0 0\n"),
                 link = folder.path() / "link", hard = folder.path() / "hard", to_linked = folder.path() / "to linked";
  fs::create_directory(folder.path() / "sub");
  fs::create_symlink("mesh.obj", link);
  fs::create_hard_link(mesh, hard);
  fs::create_symlink("linked.obj", to_linked);
  app::files::protect_input(mesh);
  app::files::protect_input(to_linked);
  const auto before = file_names(folder.path());
  for (const fs::path& path :
       {mesh, folder.path() / "sub/../mesh.obj", fs::relative(mesh), link, hard, linked, to_linked})
    EXPECT_NE(refusal(path).find(path.string() + ": cannot be written: it is the input "), std::string::npos) << path;
  EXPECT_EQ(file_names(folder.path()), before);
  EXPECT_EQ(read_file(mesh) + read_file(linked), "v 0 0 0\nv 1 0 0\n");
  app::files::OutputFile(folder.path() / "sub/../new").commit();
  EXPECT_TRUE(file_names(folder.path()).contains("new"));
}

TEST(OutputFile, ReplacesOnlyFilesWithItsHeading) {
  const TemporaryFolder folder;
  for (const char* text : {"", "a,b\n", "a,b\n1,2\n"}) {
    app::files::OutputFile(folder.write("file", text), "a,b\n").commit();
    EXPECT_EQ(read_file(folder.path() / "file"), "a,b\n");
  }
  for (const std::string text : {"a,b", "a,c\n1,2\n", "x"}) {
    EXPECT_THROW(app::files::OutputFile(folder.write("file", text), "a,b\n"), app::UsageError) << text;
    EXPECT_EQ(read_file(folder.path() / "file"), text);
  }
}

TEST(OutputFile, NamesThePathInErrorsAndLeavesNoFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "old");  // not a folder; permissions would not stop root
  const auto before = file_names(folder.path());
  for (const auto& [path, why] :
       {std::pair(folder.path() / "none" / "file", "No such file"), std::pair(file / "below", "Not a directory"),
        std::pair(folder.path(), "not a regular file"), std::pair(fs::path("/dev/null"), "not a regular file")}) {
    const std::string message = refusal(path);
    EXPECT_EQ(message.find(path.string() + ": cannot be written: "), 0u) << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
  EXPECT_EQ(file_names(folder.path()), before);
}

}  // namespace THIS_FILE
}  // namespace cli::test
