#pragma once
// A file that is written whole or not at all.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace app {

/// Makes the folder that results go to if it is not there. Throws UsageError if nothing can be written to it.
void prepare_folder(const std::filesystem::path& folder);

class OutputFile {
 public:
  /// Opens a temporary file beside `path`. Throws UsageError, as all of this class does, if the file could not be put
  /// there, or if there is something else than a regular file: a device must not be replaced.
  explicit OutputFile(std::filesystem::path path);
  /// Without commit() nothing is left, and what was there before stays.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// Puts the file into its place; the last thing to be done with it.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path path_;
  std::string temporary_;  // its name; empty once it is gone
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace app
