#pragma once
// A file that is removed after use, even if a signal ends the program.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace app::files {

/// Makes signals that end the program, such as SIGINT and SIGTERM, remove all temporary files first. Signals that are
/// ignored stay ignored. Call it once.
void remove_temporary_files_on_signals();

class TemporaryFile {
 public:
  /// Makes an empty file beside `path` with the permissions of any new file. Throws std::system_error, as do all
  /// members.
  explicit TemporaryFile(const std::filesystem::path& path);
  /// Removes the file unless keep_as() has kept it.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Returns the stream, which is open for writing until keep_as().
  std::FILE* stream() const { return file_.get(); }
  /// Closes the file and gives it another name; replaces an older file of that name. Call it at most once.
  void keep_as(const std::filesystem::path& path);

 private:
  std::string name_;  // empty once the file is kept
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace app::files
