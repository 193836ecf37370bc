#include "app/base/piped_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>
#include <utility>

extern char** environ;

namespace app {
namespace {

constexpr int timeout_seconds = 30;  // until the program has read what is sent, and for its end

[[noreturn]] void refuse(int error) { throw std::system_error(error, std::generic_category()); }

void close(int& descriptor) {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

/// Returns an error number, or 0.
int spawn(pid_t& child, std::vector<std::string> words, int input, int output, int errors) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int error = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

struct PipedProgram::System {
  // Descriptors, the first of each for reading. The input is a socket, not a pipe: when the program dies, sending
  // fails, and no signal ends this one.
  std::array<int, 2> input{-1, -1}, errors{-1, -1};
  pid_t child = 0;

  ~System() {
    for (int* descriptor : {&input[0], &input[1], &errors[0], &errors[1]}) close(*descriptor);
  }
};

PipedProgram::PipedProgram(std::vector<std::string> words, int output) : system_(std::make_unique<System>()) {
  assert(!words.empty());
  auto& [input, errors, child] = *system_;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.data()) != 0) refuse(errno);
  if (::pipe2(errors.data(), O_CLOEXEC) != 0) refuse(errno);
  const timeval limit{timeout_seconds, 0};
  ::setsockopt(input[1], SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  if (const int error = spawn(child, std::move(words), input[0], output, errors[1])) refuse(error);
  close(input[0]);
  close(errors[1]);
}

PipedProgram::~PipedProgram() {
  if (system_->child <= 0) return;
  ::kill(system_->child, SIGKILL);
  ::waitpid(system_->child, nullptr, 0);
}

bool PipedProgram::send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto sent = ::send(system_->input[1], bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool PipedProgram::finish() {
  close(system_->input[1]);
  if (system_->child <= 0) return false;
  int status = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(timeout_seconds);
  while (::waitpid(system_->child, &status, WNOHANG) != system_->child) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  system_->child = 0;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string PipedProgram::last_error_line() const {
  std::string text(4096, '\0');
  ::fcntl(system_->errors[0], F_SETFL, O_NONBLOCK);
  const auto length = ::read(system_->errors[0], text.data(), text.size());
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.erase(0, text.rfind('\n') + 1);
}

}  // namespace app
