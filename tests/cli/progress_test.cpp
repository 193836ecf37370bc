// Progress: on standard error, only where it is a terminal.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

/// A terminal without a window.
class Terminal {
 public:
  Terminal() : id_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (id_ >= 0 && grantpt(id_) == 0 && unlockpt(id_) == 0) device_ = ptsname(id_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() { close(id_); }

  /// Returns its file; empty where there are no such terminals.
  const std::string& device() const { return device_; }
  /// Returns what was written to it since the last call.
  std::string take() const {
    std::string text;
    std::array<char, 4096> part;
    for (ssize_t size; (size = read(id_, part.data(), part.size())) > 0;)
      text.append(part.data(), static_cast<std::size_t>(size));
    return text;
  }

 private:
  int id_;
  std::string device_;
};

struct Shown {
  Outcome outcome;
  std::string terminal;  // what standard error, a terminal, got
};

/// Runs the program with standard error, or with both outputs, on the terminal.
Shown run_on(const Terminal& terminal, const std::vector<std::string>& arguments, bool both = false) {
  Process process(arguments, "/", {}, both ? terminal.device() : "", terminal.device());
  std::string text;
  while (process.running()) {
    text += terminal.take();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  text += terminal.take();
  return {process.wait(), text};
}

const std::string cleared = "\r" + std::string(60, ' ') + "\r";

TEST(Progress, IsShownOnATerminalAndClearedBySimulate) {
  const Terminal terminal;
  if (terminal.device().empty()) GTEST_SKIP() << "no pseudo-terminals";
  const std::vector<std::string> arguments{"simulate", "--scene", "drop", "--frames", "30", "--json-lines"};
  const Shown shown = run_on(terminal, arguments);
  EXPECT_EQ(shown.outcome.status, 0);
  EXPECT_NE(shown.terminal.find("\rframe 20 of 30 "), std::string::npos) << shown.terminal;
  EXPECT_TRUE(shown.terminal.ends_with(cleared)) << shown.terminal;
  EXPECT_EQ(shown.outcome.out.find('\r'), std::string::npos);
  const Shown lines = run_on(terminal, arguments, true);
  EXPECT_EQ(lines.terminal.find("frame 20 of 30"), std::string::npos) << "the lines themselves are the progress";
}

TEST(Progress, IsShownOnATerminalAndClearedByReport) {
  const Terminal terminal;
  if (terminal.device().empty()) GTEST_SKIP() << "no pseudo-terminals";
  const TemporaryFolder folder;
  const Shown shown = run_on(terminal, {"report", "detection", "--quick", "--scene", "A", "--out", folder.path()});
  EXPECT_EQ(shown.outcome.status, 0);
  EXPECT_NE(shown.terminal.find("\rA: simulating "), std::string::npos);
  EXPECT_NE(shown.terminal.find(" 50 %"), std::string::npos);
  EXPECT_NE(shown.terminal.find(cleared), std::string::npos);
  EXPECT_EQ(shown.outcome.out.find('%'), std::string::npos) << shown.outcome.out;
}

}  // namespace THIS_FILE
}  // namespace cli::test
