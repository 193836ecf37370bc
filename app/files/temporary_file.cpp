#include "app/files/temporary_file.h"

#include <fcntl.h>
#include <semaphore.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace app::files {
namespace {

std::mutex names_mutex;  // held while a name is added, removed or changed, and after a signal until the end

/// The names of the existing files. The set is never destroyed, because a signal may come at the very end.
std::set<std::string>& temporary_names() {
  static auto& all = *new std::set<std::string>;
  return all;
}

sem_t arrived;
volatile std::sig_atomic_t signal_number = 0;

extern "C" void note_signal(int number) {
  signal_number = number;
  ::sem_post(&arrived);
}

/// Runs in a thread of its own, because a signal handler itself may call almost nothing.
void await_signal() {
  while (::sem_wait(&arrived) != 0) continue;
  const std::scoped_lock lock(names_mutex);
  for (const std::string& name : temporary_names()) std::remove(name.c_str());
  std::signal(signal_number, SIG_DFL);
  ::raise(signal_number);
}

[[noreturn]] void fail(int error) { throw std::system_error(error, std::generic_category()); }

}  // namespace

void remove_temporary_files_on_signals() {
  ::sem_init(&arrived, 0, 0);
  std::thread(await_signal).detach();
  struct sigaction action {};
  action.sa_handler = &note_signal;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU}) {
    struct sigaction before {};
    ::sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(number, &action, nullptr);
  }
}

TemporaryFile::TemporaryFile(const std::filesystem::path& path) {
  std::string name = path.string() + ".XXXXXX";
  const std::scoped_lock lock(names_mutex);
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) fail(errno);
  // mkostemp makes a private file.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);
  file_.reset(::fdopen(descriptor, "wb"));
  if (!file_) {
    const int error = errno;
    ::close(descriptor);
    std::remove(name.c_str());
    fail(error);
  }
  temporary_names().insert(name);
  name_ = std::move(name);
}

TemporaryFile::~TemporaryFile() {
  if (name_.empty()) return;
  const std::scoped_lock lock(names_mutex);
  std::remove(name_.c_str());
  temporary_names().erase(name_);
}

void TemporaryFile::keep_as(const std::filesystem::path& path) {
  assert(file_);
  // A full disk may be reported only when the file is closed.
  if (std::fclose(file_.release()) != 0) fail(errno);
  const std::scoped_lock lock(names_mutex);
  if (std::rename(name_.c_str(), path.c_str()) != 0) fail(errno);
  temporary_names().erase(name_);
  name_.clear();
}

}  // namespace app::files
