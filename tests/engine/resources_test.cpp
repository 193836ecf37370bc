#include "engine/resources.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace engine {
namespace THIS_FILE {
namespace fs = std::filesystem;

TEST(FindFolder, WorksFromAnyWorkingDirectory) {
  const fs::path before = fs::current_path();
  fs::current_path("/");
  EXPECT_TRUE(fs::exists(find_folder("shaders") / "surface.frag"));
  fs::current_path(before);
}

TEST(FindFolder, SearchesOnlyWhereTheVariableSays) {
  ::setenv("SBCOLLIDE_DATA", "/nowhere", 1);
  try {
    find_folder("shaders");
    ADD_FAILURE() << "a wrong SBCOLLIDE_DATA was ignored";
  } catch (const ResourceError& error) {
    EXPECT_NE(std::string(error.what()).find("SBCOLLIDE_DATA=/nowhere"), std::string::npos) << error.what();
  }
  ::unsetenv("SBCOLLIDE_DATA");
}

TEST(FindFolder, ErrorNamesTheFoldersSearched) {
  try {
    find_folder("no_such_folder");
    ADD_FAILURE();
  } catch (const ResourceError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("no_such_folder"), std::string::npos);
    EXPECT_NE(message.find("share/sbcollide"), std::string::npos);
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

}  // namespace THIS_FILE
}  // namespace engine
