#pragma once
// A file that is written whole or not at all.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace app {

/// Makes the folder that results go to if it is not there. Throws UsageError if nothing can be written to it; `option`
/// stands before its name there.
void prepare_folder(const std::filesystem::path& folder, std::string_view option = "--out ");

/// Writes a file whole or not at all. Throws UsageError.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The first of PREFIX_0001ENDING, PREFIX_0002ENDING, ... in a folder that is not there yet.
std::filesystem::path next_free(const std::filesystem::path& folder, const std::string& prefix,
                                const std::string& ending);

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
