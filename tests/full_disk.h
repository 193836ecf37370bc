#pragma once
// Simulates a full disk: no file of this process, or of a process that it starts, can grow beyond a few bytes.

#include <sys/resource.h>

#include <csignal>
#include <stdexcept>

namespace tests {

class FullDisk {
 public:
  /// `bytes`: the limit. The default is enough for an error message and too little for any result.
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
