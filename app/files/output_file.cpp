#include "app/files/output_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "app/base/usage_error.h"
#include "app/files/inputs.h"

namespace app::files {
namespace fs = std::filesystem;
namespace {

std::mutex names_mutex;  // held while a name is added, removed or changed

/// The names of the existing files. The set is never destroyed, because a signal may come at the very end.
std::set<std::string>& temporary_names() {
  static auto& all = *new std::set<std::string>;
  return all;
}

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
    fs::path file = folder / fmt::format("{}_{:04}{}", prefix, number, ending);
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) return file;
  }
}

void remove_temporary_files() {
  names_mutex.lock();  // until the end
  for (const std::string& name : temporary_names()) std::remove(name.c_str());
}

OutputFile::OutputFile(fs::path path, std::string_view heading) : path_(std::move(path)) {
  require_no_input(path_);
  std::error_code ignored;
  if (const fs::file_status status = fs::status(path_, ignored); fs::exists(status)) {
    if (!fs::is_regular_file(status)) fail("it is not a regular file", "name another file or folder");
    if (!may_replace(path_, heading)) fail("it exists and is not a file of this kind", "name another file or folder");
  }
  open();
  write(heading);
}

void OutputFile::open() {
  std::string name = path_.string() + ".XXXXXX";
  const std::scoped_lock lock(names_mutex);
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) fail(std::strerror(errno));
  // mkostemp makes a private file.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);
  file_.reset(::fdopen(descriptor, "wb"));
  if (!file_) {
    const int error = errno;
    ::close(descriptor);
    std::remove(name.c_str());
    fail(std::strerror(error));
  }
  temporary_names().insert(name);
  temporary_.reset(new std::string(std::move(name)));
}

void OutputFile::Remove::operator()(const std::string* temporary) const {
  const std::unique_ptr<const std::string> name(temporary);
  const std::scoped_lock lock(names_mutex);
  if (temporary_names().erase(*name) > 0) std::remove(name->c_str());
}

void OutputFile::write(std::string_view bytes) {
  if (bytes.empty()) return;  // fwrite() takes no null pointer
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail(std::strerror(errno));
}

void OutputFile::commit() {
  assert(file_);
  // A full disk may be reported only when the file is closed.
  if (std::fclose(file_.release()) != 0) fail(std::strerror(errno));
  const std::scoped_lock lock(names_mutex);
  if (std::rename(temporary_->c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
  temporary_names().erase(*temporary_);
}

void OutputFile::fail(const std::string& why, const char* advice) const {
  throw UsageError(path_.string() + ": cannot be written: " + why + "; " + advice);
}

}  // namespace app::files
