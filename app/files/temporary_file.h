#pragma once
// A file that is there for a time only, even if a signal ends the program.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace app {

/// From now on SIGHUP, SIGINT, SIGQUIT and SIGTERM remove all temporary files before they end the program as ever.
/// Those that are ignored stay ignored. Call it once.
void remove_temporary_files_on_signals();

class TemporaryFile {
 public:
  /// Makes an empty file beside `path`, with the rights of any new file. Throws std::system_error, as all of this class
  /// does.
  explicit TemporaryFile(const std::filesystem::path& path);
  /// Removes it, unless it was kept.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Open for writing until keep_as().
  std::FILE* stream() const { return file_.get(); }
  /// Closes it and gives it another name, in place of what is there.
  void keep_as(const std::filesystem::path& path);

 private:
  std::string name_;  // empty once it is kept
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace app
