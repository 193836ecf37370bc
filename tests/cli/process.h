#pragma once
// Runs the program as its users do.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cli::test {

struct Outcome {
  int status;  // -1: ended by a signal
  std::string out, err;
};

/// Runs `sbcollide arguments...` in a working directory; neither output is a terminal.
Outcome run(const std::vector<std::string>& arguments, const std::filesystem::path& where = "/");

/// What `simulate --json` prints; fails the test unless it is one document, standard error empty and the status 0.
nlohmann::json simulate(std::vector<std::string> arguments);

/// A folder of its own that vanishes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& file);

}  // namespace cli::test
