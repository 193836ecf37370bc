#include "softbody/mesh/line_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace softbody {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool ends_line(char c) { return c == '\n' || c == '\r'; }
/// True for characters at the end of a file that are no text: CP/M and DOS write Ctrl-Z there, and file systems that
/// lose the end of a file leave NUL.
bool is_padding(char c) { return c == '\x1a' || c == '\0'; }
/// True if a line that begins with `c` is a statement or a comment: numbers and corners of faces begin with no letter.
bool begins_statement(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '#'; }

}  // namespace

LineReader::LineReader(const std::filesystem::path& file)
    : file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)), buffer_(std::size_t{1} << 16) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category());
}

LineReader::~LineReader() { ::close(file_); }

bool LineReader::next(std::string_view& line, bool cr_alone) {
  number_ = lines_read_ + 1;
  if (!has(0)) return false;
  std::size_t begin, end, after = 0;  // of the last of the joined lines, and where the next one begins
  do {
    begin = after;
    end = find(ends_line, begin);
    after = has(end) ? end + 1 : end;
    line_end_ = after == end ? End::file : at(end) == '\n' ? End::lf : End::cr;
    if (line_end_ == End::cr && !cr_alone && has(after) && at(after) == '\n') ++after, line_end_ = End::lf;
    ++lines_read_;
  } while (joins_next(begin, end, after));
  if (end > 0 && is_padding(at(end - 1))) {
    const std::size_t other = find([](char c) { return !is_padding(c) && !is_blank(c) && !ends_line(c); }, after);
    if (!has(other)) {
      after = other;
      while (end > 0 && is_padding(at(end - 1))) --end;
    }
  }
  line = {buffer_.data() + begin_, end};
  if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  begin_ += after;
  return true;
}

std::string_view LineReader::bytes(std::size_t count) {
  assert(count <= max_line_length);
  while (end_ - begin_ < count)
    if (!read_more()) return {};
  begin_ += count;
  return {buffer_.data() + begin_ - count, count};
}

/// Joins the line with the next one and returns true, if the line ends with a backslash. Does not join them if the next
/// one is a statement: then the backslash is the end of a name, such as a folder's.
bool LineReader::joins_next(std::size_t begin, std::size_t end, std::size_t after) {
  std::size_t last = end;
  while (last > begin && is_blank(at(last - 1))) --last;
  if (last == begin || at(last - 1) != '\\' || after == end) return false;
  const std::size_t first = find([](char c) { return !is_blank(c); }, after);
  if (has(first) && begins_statement(at(first))) return false;
  std::memset(buffer_.data() + begin_ + last - 1, ' ', after - (last - 1));
  return true;
}

/// Returns the offset of the first such character from `offset` on, or of the end of the file if there is none.
std::size_t LineReader::find(bool (*is_such)(char), std::size_t offset) {
  while (has(offset) && !is_such(at(offset))) ++offset;
  return offset;
}

/// Moves the unread rest to the start of the buffer and reads more. Returns false at the end of the file.
bool LineReader::read_more() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) {
    if (end_ == max_line_length) throw std::length_error("the line is longer than 1 MiB");
    buffer_.resize(2 * end_);
  }
  ssize_t count;
  do count = ::read(file_, buffer_.data() + end_, buffer_.size() - end_);
  while (count < 0 && errno == EINTR);
  if (count < 0) throw std::system_error(errno, std::generic_category());
  end_ += static_cast<std::size_t>(count);
  return count > 0;
}

}  // namespace softbody
