#include "softbody/line_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace softbody {

LineReader::LineReader(const std::filesystem::path& file)
    : file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)), buffer_(std::size_t{1} << 16) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category());
}

LineReader::~LineReader() { ::close(file_); }

bool LineReader::next(std::string_view& line) {
  number_ = lines_read_ + 1;
  std::size_t from = begin_;  // where the last of the joined lines begins
  std::size_t seen = begin_;  // no newline between `from` and here
  for (;;) {
    if (const void* newline = std::memchr(buffer_.data() + seen, '\n', end_ - seen)) {
      const auto at = static_cast<std::size_t>(static_cast<const char*>(newline) - buffer_.data());
      ++lines_read_;
      seen = at + 1;
      const bool joined = joins_next(from, at);
      from = seen;
      if (joined) continue;
      line = {buffer_.data() + begin_, at - begin_};
      begin_ = seen;
      break;
    }
    from -= begin_;
    seen = end_ - begin_;
    if (read_more()) continue;
    if (begin_ == end_) return false;
    line = {buffer_.data() + begin_, end_ - begin_};
    begin_ = end_;
    ++lines_read_;
    break;
  }
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

/// Moves the rest to the buffer's start and reads on; false at the end of the file.
bool LineReader::read_more() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) {
    if (end_ == longest_line) throw std::length_error("the line is longer than 1 MiB");
    buffer_.resize(2 * end_);
  }
  ssize_t count;
  do count = ::read(file_, buffer_.data() + end_, buffer_.size() - end_);
  while (count < 0 && errno == EINTR);
  if (count < 0) throw std::system_error(errno, std::generic_category());
  end_ += static_cast<std::size_t>(count);
  return count > 0;
}

/// Whether the line that ends before the newline at `end` goes on. Comments do not: they may end with a Windows path.
bool LineReader::joins_next(std::size_t begin, std::size_t end) {
  std::string_view line(buffer_.data() + begin, end - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (!line.ends_with('\\') || line.find('#') != line.npos) return false;
  std::memset(buffer_.data() + begin + line.size() - 1, ' ', end + 1 - (begin + line.size() - 1));
  return true;
}

}  // namespace softbody
