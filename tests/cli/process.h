#pragma once
// Runs the program as its users do.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace cli::test {

struct Outcome {
  int status;  // -1: ended by a signal
  std::string out, err;
};

/// Runs `sbcollide arguments...` in a working directory; neither output is a terminal. environment: "NAME=value" of
/// what differs from the test's own.
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

using tests::TemporaryFolder;
std::string read_file(const std::filesystem::path& file);
std::set<std::string> file_names(const std::filesystem::path& folder);

}  // namespace cli::test
