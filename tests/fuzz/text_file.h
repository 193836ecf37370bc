#pragma once
// The fuzzer's bytes as a file, for readers that take a path.

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace fuzz {

/// One file a process, written anew each time and gone at the end.
class TextFile {
 public:
  explicit TextFile(const char* extension)
      : path_(std::filesystem::temp_directory_path() / ("sbcollide_fuzz_" + std::to_string(::getpid()) + extension)) {}
  ~TextFile() {
    std::error_code gone;
    std::filesystem::remove(path_, gone);
  }
  const std::filesystem::path& write(const std::uint8_t* data, std::size_t size) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path_;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What every reader promises of its errors: one line that names the file.
inline void require_one_line(std::string_view message, const std::filesystem::path& file) {
  if (message.find('\n') == message.npos && message.find(file.filename().string()) != message.npos) return;
  std::fprintf(stderr, "not one line that names the file: %.*s\n", static_cast<int>(message.size()), message.data());
  std::abort();
}

}  // namespace fuzz
