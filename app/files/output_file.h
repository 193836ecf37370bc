#pragma once
// A file that is written whole or not at all.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace app::files {

/// Makes the folder for results if it is missing. Throws UsageError if the folder cannot be written to; the message
/// begins with `option` and the folder's name.
void prepare_folder(const std::filesystem::path& folder, std::string_view option = "--out ");

/// Writes a file whole or not at all. Throws UsageError.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Returns the first path of PREFIX_0001ENDING, PREFIX_0002ENDING, ... in a folder that does not exist yet.
std::filesystem::path next_free_path(const std::filesystem::path& folder, const std::string& prefix,
                                     const std::string& ending);

/// Removes the temporary files of all OutputFiles. To be called where the program ends at once: threads that write
/// files wait from then on.
void remove_temporary_files();

class OutputFile {
 public:
  /// Opens a temporary file beside `path`, with the permissions of any new file, and writes `heading` to it. Throws
  /// UsageError, as do all members, if the file cannot be written or `path` may not be replaced: it is an input of the
  /// run, or not a regular file, or a file that is not empty and does not begin with `heading`.
  explicit OutputFile(std::filesystem::path path, std::string_view heading = {});

  void write(std::string_view bytes);
  /// Returns the descriptor of the file, for another process that writes it.
  int descriptor() const { return ::fileno(file_.get()); }
  /// Puts the file into its place. This must be the last call. Without it no new file remains, and an older one stays.
  void commit();

 private:
  /// Removes the file, unless it is in its place.
  struct Remove {
    void operator()(const std::string* temporary) const;
  };

  void open();
  [[noreturn]] void fail(const std::string& why,
                         const char* advice = "name another one, where you may write and there is room") const;

  std::filesystem::path path_;
  std::unique_ptr<std::string, Remove> temporary_;  // the name of the file until it is in its place
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace app::files
