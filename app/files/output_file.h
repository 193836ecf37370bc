#pragma once
// A file that is written whole or not at all.

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "app/files/temporary_file.h"

namespace app::files {

/// Makes the folder for results if it is missing. Throws UsageError if the folder cannot be written to; the message
/// begins with `option` and the folder's name.
void prepare_folder(const std::filesystem::path& folder, std::string_view option = "--out ");

/// Writes a file whole or not at all. Throws UsageError.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Returns the first path of PREFIX_0001ENDING, PREFIX_0002ENDING, ... in a folder that does not exist yet.
std::filesystem::path next_free_path(const std::filesystem::path& folder, const std::string& prefix,
                                     const std::string& ending);

class OutputFile {
 public:
  /// Opens a temporary file beside `path` and writes `heading` to it. Throws UsageError, as do all members, if the file
  /// cannot be written or `path` may not be replaced: it is an input of the run, or not a regular file, or a file that
  /// is not empty and does not begin with `heading`.
  explicit OutputFile(std::filesystem::path path, std::string_view heading = {});

  void write(std::string_view bytes);
  /// Returns the descriptor of the file, for another process that writes it.
  int descriptor() const { return ::fileno(file_->stream()); }
  /// Puts the file into its place. This must be the last call. Without it no new file remains, and an older one stays.
  void commit();

 private:
  void attempt(const auto& action) const;
  [[noreturn]] void fail(const std::string& why,
                         const char* advice = "name another one, where you may write and there is room") const;

  std::filesystem::path path_;
  std::optional<TemporaryFile> file_;
};

}  // namespace app::files
