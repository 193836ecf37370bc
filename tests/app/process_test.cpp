#include "app/base/process.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <system_error>

namespace app {
namespace THIS_FILE {

class ProcessTest : public testing::Test {
 protected:
  std::string output() const {
    std::rewind(file.get());
    std::string text;
    for (int c = std::fgetc(file.get()); c != EOF; c = std::fgetc(file.get())) text.push_back(char(c));
    return text;
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::tmpfile(), &std::fclose};
  const int descriptor = ::fileno(file.get());
};

TEST_F(ProcessTest, ReadsAllThatItIsSent) {
  const std::string text(1 << 20, 'x');  // more than a socket holds
  Process cat({"cat"}, descriptor);
  EXPECT_TRUE(cat.send(std::as_bytes(std::span(text))));
  EXPECT_TRUE(cat.finish());
  EXPECT_TRUE(output() == text);
  EXPECT_EQ(cat.errors(), "");
}

TEST_F(ProcessTest, SaysThatItFailedAndItsLastErrorLine) {
  Process shell({"sh", "-c", "echo first >&2; echo second line >&2; exit 1"}, descriptor);
  EXPECT_FALSE(shell.finish());
  EXPECT_EQ(shell.errors(), "first\nsecond line\n");
  EXPECT_FALSE(shell.finish());
}

TEST_F(ProcessTest, IsNoLongerSentToOnceItHasEnded) {
  Process shell({"true"}, descriptor);
  const std::string text = "more";
  while (shell.send(std::as_bytes(std::span(text)))) continue;
  EXPECT_TRUE(shell.finish());
}

TEST_F(ProcessTest, RefusesAProgramThatIsNotThere) {
  try {
    Process nothing({"no-such-program"}, descriptor);
    ADD_FAILURE();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

}  // namespace THIS_FILE
}  // namespace app
