#pragma once
// Runs the program as a user does.

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace cli::test {

using tests::TemporaryFolder;
using Words = std::vector<std::string>;

/// Returns both lists, one behind the other.
inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Outcome {
  int status;  // -1: ended by a signal
  std::string out, err;
  int signal = 0;  // the signal that ended it
};

/// Runs `sbcollide arguments...` in a working directory. Neither output is a terminal. environment: changes of the
/// test's own environment, as "NAME=value". No signal is ignored. out, err: files or devices for standard output and
/// standard error; empty: files of the process's own.
class Process {
 public:
  explicit Process(const Words& arguments, const std::filesystem::path& where = "/", const Words& environment = {},
                   const std::filesystem::path& out = {}, const std::filesystem::path& err = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running();
  void send(int signal) const;
  Outcome wait();

 private:
  TemporaryFolder folder_;
  std::filesystem::path out_, err_;
  pid_t id_ = 0;
};

/// Runs the program to its end.
Outcome run(const Words& arguments, const std::filesystem::path& where = "/", const Words& environment = {});

/// Returns what `command arguments... --json` prints. Fails the test unless it is one document, standard error is
/// `err` and the status is 0.
nlohmann::json document(const std::string& command, const Words& arguments, const std::string& err = {});
inline nlohmann::json simulate(const Words& arguments, const std::string& err = {}) {
  return document("simulate", arguments, err);
}
inline nlohmann::json detect(const Words& arguments) { return document("detect", arguments); }

/// Fails the test unless the program refuses the arguments in one line with these words, and prints nothing else.
void expect_refused(const Words& arguments, const Words& words, const Words& environment = {});

std::string read_file(const std::filesystem::path& file);
std::set<std::string> file_names(const std::filesystem::path& folder);

}  // namespace cli::test
