#pragma once
// A file that is written whole or not at all.

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "app/files/temporary_file.h"

namespace app {

/// Makes the folder that results go to if it is not there. Throws UsageError if nothing can be written to it; `option`
/// stands before its name there.
void prepare_folder(const std::filesystem::path& folder, std::string_view option = "--out ");

/// Writes a file whole or not at all. Throws UsageError.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The first of PREFIX_0001ENDING, PREFIX_0002ENDING, ... in a folder that is not there yet.
std::filesystem::path next_free_path(const std::filesystem::path& folder, const std::string& prefix,
                                     const std::string& ending);

class OutputFile {
 public:
  /// Opens a temporary file beside `path` and writes `heading` to it. Throws UsageError, as all of this class does, if
  /// no file could be put there, or none may: there is an input of the run, something else than a regular file, or a
  /// file that does not begin with `heading`. An empty file may be replaced.
  explicit OutputFile(std::filesystem::path path, std::string_view heading = {});

  void write(std::string_view bytes);
  /// For another process that is to write the file.
  int descriptor() const { return ::fileno(file_->stream()); }
  /// Puts the file into its place; the last thing to be done with it. Without it nothing is left, and what was there
  /// before stays.
  void commit();

 private:
  void attempt(const auto& action) const;
  [[noreturn]] void fail(const std::string& why,
                         const char* advice = "name another one, where you may write and there is room") const;

  std::filesystem::path path_;
  std::optional<TemporaryFile> file_;
};

}  // namespace app
