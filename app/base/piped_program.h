#pragma once
// Another program that this one starts, such as ffmpeg.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace app {

/// A running program. It reads from standard input what it is sent.
class PipedProgram {
 public:
  /// Starts a program that is found in $PATH. words: its name and its arguments. output: an open file, by its
  /// descriptor, which becomes the standard output. Throws std::system_error, with std::errc::no_such_file_or_directory
  /// if there is no such program.
  PipedProgram(std::vector<std::string> words, int output);
  /// Ends the program if it still runs.
  ~PipedProgram();
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  /// Returns false if the program reads no more. No signal tells of it.
  bool send(std::span<const std::byte> bytes);
  /// Ends the input and waits for the program. Returns true if it reports success, once.
  bool finish();
  /// Returns the last line on its standard error; empty if there is none. Call it after finish().
  std::string last_error_line() const;

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace app
