#pragma once
// Reads the lines of a text file, such as an OBJ file, of any size, piece by piece; also files with a binary part.

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace softbody {

class LineReader {
 public:
  static constexpr std::size_t max_line_length = std::size_t{1} << 20;  // bytes; no sensible file has such lines

  /// Throws std::system_error, as next() does, if the file cannot be read.
  explicit LineReader(const std::filesystem::path& file);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Reads the next line into `line`, without its end (LF, CRLF or CR) and without a byte order mark before it. Returns
  /// false if there is none. The text is valid until the next call. A line that ends with a backslash is joined with
  /// the next one, unless that one begins with a letter or #; the backslash and the line end become spaces. Ctrl-Z and
  /// NUL at the end of the file are skipped. cr_alone: CR ends a line by itself, and an LF behind it is of the next
  /// line or of a binary part. Throws std::length_error if the line is longer than max_line_length.
  bool next(std::string_view& line, bool cr_alone = false);
  /// Returns the next `count` bytes as they are; empty if the file has fewer. They are valid until the next call.
  /// count: at most max_line_length.
  std::string_view bytes(std::size_t count);
  /// Returns the number, from 1, of the line that next() returned last or at which it threw. Of joined lines it is the
  /// number of the first one.
  std::uint64_t number() const { return number_; }
  enum class End { file, cr, lf };  // lf: of CRLF, too
  /// Returns what ended the line that next() returned last.
  End end() const { return line_end_; }

 private:
  // Offsets count from begin_, so that they outlast read_more().
  /// True if the file has a character at `offset`, which is at most one more than any offset asked for before.
  bool has(std::size_t offset) { return begin_ + offset < end_ || read_more(); }
  char at(std::size_t offset) const { return buffer_[begin_ + offset]; }
  std::size_t find(bool (*is_such)(char), std::size_t offset);
  bool joins_next(std::size_t begin, std::size_t end, std::size_t after);
  bool read_more();

  int file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of the part of the buffer that next() has not returned yet
  std::uint64_t number_ = 0, lines_read_ = 0;
  End line_end_ = End::file;
};

}  // namespace softbody
