#include "app/base/process.h"

#include <stdexcept>

#include "app/base/usage_error.h"

#ifdef __linux__

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <new>

namespace app {

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

Process::Process(std::vector<std::string> words, const std::vector<int>& handles, const std::filesystem::path& output) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> channel{-1, -1};
  ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, channel.data());
  channel_ = channel[0];
  std::vector<int> passed{channel[1]};
  passed.insert(passed.end(), handles.begin(), handles.end());
  const int end = channel_inside + static_cast<int>(passed.size());
  for (int& handle : passed) handle = ::fcntl(handle, F_DUPFD_CLOEXEC, end);  // none is overwritten before it is copied
  ::close(channel[1]);
  id_ = ::fork();
  if (id_ == 0) {  // from here on only system calls, since other threads may have held any lock
    ::setpgid(0, 0);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    ::dup2(STDOUT_FILENO, STDERR_FILENO);
    for (int number = channel_inside; const int handle : passed) ::dup2(handle, number++);
    ::close_range(static_cast<unsigned>(end), ~0u, 0);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  for (const int handle : passed) ::close(handle);
  if (id_ > 0) return;
  ::close(channel_);
  throw UsageError("no further process can be started: end others");
}

Process::~Process() {
  for (const int all : {id_, -id_}) ::kill(all, SIGKILL);  // it, and its group
  ::waitpid(id_, nullptr, 0);
  ::close(channel_);
}

std::optional<std::string> Process::end() const {
  siginfo_t found{};
  // It stays a zombie until the destructor: no other process can get its number before.
  if (::waitid(P_PID, static_cast<id_t>(id_), &found, WEXITED | WNOHANG | WNOWAIT) != 0 || found.si_pid == 0)
    return std::nullopt;
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
Process::Process(std::vector<std::string>, const std::vector<int>&, const std::filesystem::path&) {}
Process::~Process() = default;
std::optional<std::string> Process::end() const { return "not started"; }
void send(int, std::span<const std::byte>) {}
bool receive(int, std::span<std::byte>, int) { return false; }
std::span<std::byte> take_memory(int, std::size_t) { return {}; }
void confine(std::size_t) {}
void* load_function(int, const char*) { return nullptr; }

}  // namespace app

#endif
