#include "app/files/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "app/base/usage_error.h"

namespace app {
namespace fs = std::filesystem;

void prepare_folder(const std::filesystem::path& folder, std::string_view option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK) != 0)
    throw UsageError(std::string(option) + folder.string() + ": cannot be written to; name a folder of your own");
}

void write_file(const fs::path& file, std::string_view bytes) {
  OutputFile out(file);
  out.write(bytes);
  out.commit();
}

fs::path next_free(const fs::path& folder, const std::string& prefix, const std::string& ending) {
  for (int number = 1;; ++number) {
    std::string digits = std::to_string(number);
    digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
    fs::path file = folder / (prefix + "_" + digits + ending);
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) return file;
  }
}

OutputFile::OutputFile(fs::path path) : path_(std::move(path)) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) fail("it is not a regular file");
  std::string name = path_.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail(std::strerror(errno));
  // mkstemp makes it private; the result gets the rights of any other new file.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);
  file_.reset(::fdopen(descriptor, "wb"));
  if (!file_) {
    const std::string why = std::strerror(errno);
    ::close(descriptor);
    std::remove(name.c_str());
    fail(why);
  }
  temporary_ = std::move(name);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail(std::strerror(errno));
}

void OutputFile::commit() {
  // A full disk may show only when the file is closed.
  if (std::fclose(file_.release()) != 0) fail(std::strerror(errno));
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
  temporary_.clear();
}

void OutputFile::fail(const std::string& why) const {
  throw UsageError(path_.string() + ": cannot be written: " + why +
                   "; name a file where you may write and there is room");
}

}  // namespace app
