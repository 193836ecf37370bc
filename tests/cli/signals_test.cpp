// Checks what remains when a signal ends the program.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

class Signals : public testing::TestWithParam<int> {};

TEST_P(Signals, EndTheProgramAndLeaveNoTemporaryFile) {
  const TemporaryFolder folder;
  std::string crowd;
  for (int i = 0; i < 300; ++i) crowd += "v 0 0 0\n";
  const std::string obj = folder.write("crowd.obj", crowd), csv = folder.path() / "contacts.csv";
  const auto before = file_names(folder.path());
  Process detect({"detect", obj, "--tolerance", "1", "--repeat", "100000", "--contacts", csv});  // for minutes
  while (detect.running() && file_names(folder.path()) == before)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  detect.send(GetParam());
  const Outcome o = detect.wait();
  EXPECT_EQ(o.signal, GetParam()) << o.err;
  EXPECT_EQ(o.out + o.err, "");
  EXPECT_EQ(file_names(folder.path()), before);
}

INSTANTIATE_TEST_SUITE_P(All, Signals, testing::Values(SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGXCPU));

}  // namespace THIS_FILE
}  // namespace cli::test
