#pragma once
// Runs the program as its users do.

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace cli::test {

using tests::TemporaryFolder;

struct Outcome {
  int status;  // -1: ended by a signal
  std::string out, err;
  int signal = 0;  // that ended it
};

/// `sbcollide arguments...` in a working directory; neither output is a terminal. environment: "NAME=value" of what
/// differs from the test's own. No signal is ignored.
class Process {
 public:
  explicit Process(const std::vector<std::string>& arguments, const std::filesystem::path& where = "/",
                   const std::vector<std::string>& environment = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running();
  void send(int signal) const;
  Outcome wait();

 private:
  TemporaryFolder folder_;
  pid_t id_ = 0;
};

/// Runs it to its end.
Outcome run(const std::vector<std::string>& arguments, const std::filesystem::path& where = "/",
            const std::vector<std::string>& environment = {});

/// What `command arguments... --json` prints; fails the test unless it is one document, standard error empty and the
/// status 0.
nlohmann::json document(const std::string& command, std::vector<std::string> arguments);
inline nlohmann::json simulate(const std::vector<std::string>& arguments) { return document("simulate", arguments); }
inline nlohmann::json detect(const std::vector<std::string>& arguments) { return document("detect", arguments); }

/// Fails the test unless the program refuses in one line with these words in it, and prints nothing else.
void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words,
                    const std::vector<std::string>& environment = {});

std::string read_file(const std::filesystem::path& file);
std::set<std::string> file_names(const std::filesystem::path& folder);

}  // namespace cli::test
