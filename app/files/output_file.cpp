#include "app/files/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "app/base/usage_error.h"
#include "app/files/inputs.h"

namespace app::files {
namespace fs = std::filesystem;
namespace {

/// Returns true if nothing is lost when a file with this heading replaces `file`.
bool may_replace(const fs::path& file, std::string_view heading) {
  std::string beginning(heading.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return beginning == heading || (in.eof() && in.gcount() == 0);
}

}  // namespace

void prepare_folder(const std::filesystem::path& folder, std::string_view option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK | X_OK) != 0)
    throw UsageError(std::string(option) + folder.string() + ": cannot be written to; name a folder of your own");
}

void write_file(const fs::path& file, std::string_view bytes) {
  OutputFile out(file);
  out.write(bytes);
  out.commit();
}

fs::path next_free_path(const fs::path& folder, const std::string& prefix, const std::string& ending) {
  for (int number = 1;; ++number) {
    std::string digits = std::to_string(number);
    digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
    fs::path file = folder / (prefix + "_" + digits + ending);
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) return file;
  }
}

OutputFile::OutputFile(fs::path path, std::string_view heading) : path_(std::move(path)) {
  require_no_input(path_);
  std::error_code ignored;
  if (const fs::file_status status = fs::status(path_, ignored); fs::exists(status)) {
    if (!fs::is_regular_file(status)) fail("it is not a regular file", "name another file");
    if (!may_replace(path_, heading)) fail("it exists and is not a file of this kind", "name another file");
  }
  attempt([&] { file_.emplace(path_); });
  write(heading);
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_->stream()) != bytes.size()) fail(std::strerror(errno));
}

void OutputFile::commit() {
  attempt([&] { file_->keep_as(path_); });
}

void OutputFile::attempt(const auto& action) const {
  try {
    action();
  } catch (const std::system_error& error) {
    fail(error.code().message());
  }
}

void OutputFile::fail(const std::string& why, const char* advice) const {
  throw UsageError(path_.string() + ": cannot be written: " + why + "; " + advice);
}

}  // namespace app::files
