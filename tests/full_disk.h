#pragma once
// A disk that is full while this lives: no file, of this process or of those that it starts, grows beyond some bytes.

#include <sys/resource.h>

#include <csignal>
#include <stdexcept>

namespace tests {

class FullDisk {
 public:
  /// bytes: enough for an error message, too few for any result.
  explicit FullDisk(rlim_t bytes = 400) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit less{bytes, before_.rlim_max};
    if (setrlimit(RLIMIT_FSIZE, &less) != 0) throw std::runtime_error("the size of files cannot be limited");
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace tests
