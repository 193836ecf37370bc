#pragma once
// Other processes. All that differs from system to system is in process.cpp, which knows Linux; elsewhere no process
// can be started.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace app {

/// A file in memory, for this process and others: 0 at first, and nobody can change its size. It takes memory where it
/// has been written to.
class SharedMemory {
 public:
  /// Throws std::bad_alloc.
  explicit SharedMemory(std::size_t size);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;

  std::span<std::byte> bytes() const { return bytes_; }
  int handle() const { return handle_; }

 private:
  int handle_ = -1;
  std::span<std::byte> bytes_;
};

/// Another program that this one starts: ffmpeg, a compiler, a guest. It has no other handles than it is given.
class Process {
 public:
  static constexpr int channel_inside = 3, first_handle = 4;
  static constexpr const char* this_program = "/proc/self/exe";

  /// words: the program, which is found in $PATH, and its arguments. output: an open file for its standard output; -1:
  /// that goes where its errors go. Throws UsageError, or std::system_error, with std::errc::no_such_file_or_directory
  /// if there is no such program.
  /// Without handles it reads what send() sends, and its errors are kept. With handles, which have the numbers from
  /// first_handle on inside, it exchanges messages by a channel; it reads nothing, and its errors are lost.
  Process(std::vector<std::string> words, int output, const std::vector<int>& handles = {});
  /// Ends it, and what it has started.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Returns false if the program reads no more. No signal tells of it.
  bool send(std::span<const std::byte> bytes);
  /// Lets it read the end of its input.
  void end_input();
  /// Ends the input and waits for the program. Returns true if it reports success.
  bool finish();
  /// Returns what it has printed on its standard error.
  std::string errors() const;
  /// The end of the channel whose other end is channel_inside.
  int channel() const { return channel_; }
  /// Returns how it ended: "ended by signal SIGSEGV (Segmentation fault)", "ended itself with status 0"; nothing while
  /// it runs.
  std::optional<std::string> end() const;

 private:
  Process() = default;

  int id_ = 0, channel_ = -1, errors_ = -1;
};

/// Sends a message, which is lost if nobody has the other end. Messages arrive whole and in order.
void send(int channel, std::span<const std::byte> message);
/// Waits for a message of this length, so many milliseconds at most if that is not -1. Returns true if one has come.
bool receive(int channel, std::span<std::byte> message, int milliseconds = -1);

// In a process that is to harm nothing.
/// Takes the memory of another process. Only the first `writable` bytes, whole pages, can be written to.
std::span<std::byte> take_memory(int handle, std::size_t writable);
/// Lets this process take at most so many more bytes of memory, and start neither processes nor threads. It ends with
/// the thread that has started it.
void confine(std::size_t memory);
/// Loads a library and returns its function. Throws std::runtime_error with why there is none.
void* load_function(int library, const char* name);

}  // namespace app
