#include "app/base/process.h"

#include <stdexcept>
#include <system_error>

#include "app/base/usage_error.h"

#ifdef __linux__

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <new>
#include <thread>
#include <utility>

namespace app {

namespace {

constexpr int timeout_seconds = 30;  // until the program has read what is sent, and for its end

[[noreturn]] void refuse(int error) { throw std::system_error(error, std::generic_category()); }

/// Returns how a process has ended; 0 while it runs. It stays a zombie until its Process ends: no other process can get
/// its number before.
siginfo_t look_at(int id) {
  siginfo_t found{};
  if (::waitid(P_PID, static_cast<id_t>(id), &found, WEXITED | WNOHANG | WNOWAIT) != 0) found = {};
  return found;
}

}  // namespace

SharedMemory::SharedMemory(std::size_t size) : handle_(::memfd_create("sbcollide", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
  // Sealed: who reads beyond the end of a file that has become smaller is ended.
  if (::ftruncate(handle_, static_cast<off_t>(size)) == 0 &&
      ::fcntl(handle_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0)
    bytes_ = take_memory(handle_, size);
  if (bytes_.size() == size) return;
  ::close(handle_);
  throw std::bad_alloc();
}

SharedMemory::~SharedMemory() {
  ::munmap(bytes_.data(), bytes_.size());
  ::close(handle_);
}

std::span<std::byte> take_memory(int handle, std::size_t writable) {
  struct stat file {};
  ::fstat(handle, &file);
  const auto size = static_cast<std::size_t>(file.st_size);
  void* at = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, handle, 0);
  if (at == MAP_FAILED) return {};
  auto* begin = static_cast<std::byte*>(at);
  if (writable < size) ::mprotect(begin + writable, size - writable, PROT_READ);
  return {begin, size};
}

Process::Process(std::vector<std::string> words, int output, const std::vector<int>& handles) : Process() {
  assert(!words.empty());
  const bool by_messages = !handles.empty();
  std::array<int, 2> ends{-1, -1};
  // Not a pipe: when the program dies, sending fails, and no signal ends this one.
  if (::socketpair(AF_UNIX, (by_messages ? SOCK_SEQPACKET : SOCK_STREAM) | SOCK_CLOEXEC, 0, ends.data()) != 0)
    refuse(errno);
  channel_ = ends[0];
  const timeval limit{timeout_seconds, 0};
  ::setsockopt(channel_, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  errors_ = by_messages ? ::open("/dev/null", O_RDWR | O_CLOEXEC) : ::memfd_create("errors", MFD_CLOEXEC);
  std::vector<int> inside{by_messages ? errors_ : ends[1], output >= 0 ? output : errors_, errors_};
  if (by_messages) inside.push_back(ends[1]);
  inside.insert(inside.end(), handles.begin(), handles.end());
  const int count = static_cast<int>(inside.size());
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (int number = 0; int& handle : inside) {
    handle = ::fcntl(handle, F_DUPFD_CLOEXEC, count);  // none is overwritten before it is copied
    ::posix_spawn_file_actions_adddup2(&actions, handle, number++);
  }
  ::posix_spawn_file_actions_addclosefrom_np(&actions, count);
  posix_spawnattr_t own_group;
  ::posix_spawnattr_init(&own_group);
  ::posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = ::posix_spawnp(&id_, arguments[0], &actions, &own_group, arguments.data(), environ);
  ::posix_spawnattr_destroy(&own_group);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  for (const int handle : inside) ::close(handle);
  if (error != 0) id_ = 0;
  if (error == EAGAIN) throw UsageError("no further process can be started: end others");
  if (error != 0) refuse(error);
}

Process::~Process() {
  if (id_ > 0) {
    for (const int all : {id_, -id_}) ::kill(all, SIGKILL);  // it, and its group
    ::waitpid(id_, nullptr, 0);
  }
  end_input();
  if (errors_ >= 0) ::close(errors_);
}

bool Process::send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto sent = ::send(channel_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

void Process::end_input() {
  if (channel_ >= 0) ::close(std::exchange(channel_, -1));
}

bool Process::finish() {
  end_input();
  const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(timeout_seconds);
  for (; !end(); std::this_thread::sleep_for(std::chrono::milliseconds(10)))
    if (std::chrono::steady_clock::now() > latest) return false;
  const siginfo_t found = look_at(id_);
  return found.si_code == CLD_EXITED && found.si_status == 0;
}

std::string Process::errors() const {
  struct stat file {};
  ::fstat(errors_, &file);
  std::string text(static_cast<std::size_t>(file.st_size), '\0');
  const auto length = ::pread(errors_, text.data(), text.size(), 0);
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return text;
}

std::optional<std::string> Process::end() const {
  const siginfo_t found = look_at(id_);
  if (found.si_pid == 0) return std::nullopt;
  if (found.si_code == CLD_EXITED) return "ended itself with status " + std::to_string(found.si_status);
  const char* name = ::sigabbrev_np(found.si_status);
  return std::string("ended by signal SIG") + (name ? name : "") + " (" + ::strsignal(found.si_status) + ")";
}

void send(int channel, std::span<const std::byte> message) {
  ::send(channel, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

bool receive(int channel, std::span<std::byte> message, int milliseconds) {
  pollfd source{channel, POLLIN, 0};
  if (::poll(&source, 1, milliseconds) <= 0) return false;
  const ssize_t read = ::recv(channel, message.data(), message.size(), MSG_DONTWAIT | MSG_TRUNC);
  if (read <= 0) ::usleep(1000);  // closed: whoever asks again does not spin
  return read == static_cast<ssize_t>(message.size());
}

void confine(std::size_t memory) {
  // The sanitizers take address space for themselves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + memory;
  const rlimit space{most, most};
  ::setrlimit(RLIMIT_AS, &space);
#endif
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // RLIMIT_NPROC counts all processes of the user, and does not hold for root.
  std::vector<sock_filter> filter;
  const auto load = [&](std::size_t place) {
    filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(place)));
  };
  const auto refuse = [&](unsigned short comparison, unsigned value, bool if_true = true) {
    filter.push_back(sock_filter{static_cast<unsigned short>(BPF_JMP | comparison | BPF_K), !if_true, if_true, value});
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EAGAIN));
  };
#ifdef __x86_64__  // also has the system calls of 32 bits, and of x32, by other numbers
  load(offsetof(seccomp_data, arch));
  refuse(BPF_JEQ, AUDIT_ARCH_X86_64, false);
#endif
  load(offsetof(seccomp_data, nr));
#ifdef __x86_64__
  refuse(BPF_JGE, 0x40000000);
  refuse(BPF_JEQ, SYS_fork);
  refuse(BPF_JEQ, SYS_vfork);
#endif
  refuse(BPF_JEQ, SYS_clone);
  refuse(BPF_JEQ, SYS_clone3);
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

void* load_function(int library, const char* name) {
  const std::string file = "/proc/self/fd/" + std::to_string(library);
  void* opened = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (void* function = opened ? ::dlsym(opened, name) : nullptr) return function;
  const std::string why = ::dlerror();  // "FILE: ..."
  throw std::runtime_error(why.starts_with(file) ? why.substr(file.size() + 2) : why);
}

}  // namespace app

#else

namespace app {

SharedMemory::SharedMemory(std::size_t) { throw UsageError("methods of your own need Linux"); }
SharedMemory::~SharedMemory() = default;
Process::Process(std::vector<std::string>, int, const std::vector<int>&) {
  throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory));
}
Process::~Process() = default;
bool Process::send(std::span<const std::byte>) { return false; }
void Process::end_input() {}
bool Process::finish() { return false; }
std::string Process::errors() const { return {}; }
std::optional<std::string> Process::end() const { return "not started"; }
void send(int, std::span<const std::byte>) {}
bool receive(int, std::span<std::byte>, int) { return false; }
std::span<std::byte> take_memory(int, std::size_t) { return {}; }
void confine(std::size_t) {}
void* load_function(int, const char*) { return nullptr; }

}  // namespace app

#endif
