#include "app/obj.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

#include "app/line_reader.h"

namespace app {
namespace {

using collide::Index;

/// The words of a line; a # ends it.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// Empty if there is none left.
  std::string_view next() {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; };
    const char *at = rest_.data(), *const end = at + rest_.size();
    while (at != end && is_space(*at)) ++at;
    const char* const begin = at;
    while (at != end && !is_space(*at) && *at != '#') ++at;
    rest_ = at != end && *at == '#' ? std::string_view() : std::string_view(at, static_cast<std::size_t>(end - at));
    return {begin, static_cast<std::size_t>(at - begin)};
  }

 private:
  std::string_view rest_;
};

/// A word for a message: short and printable, whatever is in the file.
std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 30;
  std::string text(word.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

/// Reads a whole number at the start of `text` and takes it away; false if there is none or it is too large.
bool take_integer(std::string_view& text, std::int64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc();
}

/// "", "/vt", "//vn" or "/vt/vn".
bool is_texture_and_normal(std::string_view text) {
  std::int64_t ignored = 0;
  const auto take_slash_and_number = [&] {
    if (!text.starts_with('/')) return false;
    text.remove_prefix(1);
    return take_integer(text, ignored);
  };
  if (text.empty()) return true;
  if (text.starts_with("//"))
    text.remove_prefix(1);
  else if (!take_slash_and_number())
    return false;
  else if (text.empty())
    return true;
  return take_slash_and_number() && text.empty();
}

class Parser {
 public:
  explicit Parser(const std::filesystem::path& file) : name_(file.string()), lines_(file) {}

  ObjBodies run() {
    std::string_view line;
    while (lines_.next(line)) {
      if (lines_.number() == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
      statement(Words(line));
    }
    if (bodies_.first.empty())
      throw ObjError(name_ + ": no vertex and no object in it; give a Wavefront OBJ file with lines such as v 0 0 0");
    bodies_.first.push_back(vertex_count());
    bodies_.edges.resize(bodies_.count());
    std::size_t begin = 0;
    for (const Face& face : faces_) {
      add_edges(std::span(corners_).subspan(begin, face.end - begin), face.line);
      begin = face.end;
    }
    return std::move(bodies_);
  }

  [[noreturn]] void fail(const std::string& what) const { fail(lines_.number(), what); }

 private:
  struct Face {
    std::size_t end;  // of its corners
    std::uint64_t line;
  };

  [[noreturn]] void fail(std::uint64_t line, const std::string& what) const {
    throw ObjError(name_ + ":" + std::to_string(line) + ": " + what);
  }

  Index vertex_count() const { return static_cast<Index>(bodies_.x.size()); }

  void statement(Words words) {
    const std::string_view keyword = words.next();
    if (keyword == "v") return vertex(words);
    if (keyword == "f") return face(words);
    if (keyword == "o") return begin_body();
    if (keyword.empty()) return;
    const char initial = keyword.front();
    if (!((initial >= 'a' && initial <= 'z') || (initial >= 'A' && initial <= 'Z')))
      fail(quoted(keyword) + " begins no OBJ statement; is this a text file in OBJ format?");
  }

  void begin_body() {
    if (bodies_.first.size() == std::numeric_limits<Index>::max()) fail("too many objects; 4294967295 are allowed");
    bodies_.first.push_back(vertex_count());
  }

  void vertex(Words words) {
    if (bodies_.first.empty()) begin_body();
    if (vertex_count() == std::numeric_limits<Index>::max()) fail("too many vertices; 4294967295 are allowed");
    std::array<float, 3> position;
    for (float& coordinate : position) coordinate = number(words.next());
    bodies_.x.push_back(position[0]);
    bodies_.y.push_back(position[1]);
    bodies_.z.push_back(position[2]);
    int further = 0;  // a weight, a colour, or both: not used, but a merged line must not pass
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      number(word);
      if (++further > 4) fail("a vertex with more than 7 numbers; write v X Y Z");
    }
  }

  float number(std::string_view word) const {
    if (word.empty()) fail("a vertex with fewer than 3 coordinates; write v X Y Z");
    std::string_view digits = word;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);  // from_chars knows no +
    float value = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) fail(quoted(word) + " is no number; write e.g. -0.25");
    // from_chars does not tell too large from too small to be a float, and leaves the value alone.
    if (error == std::errc::result_out_of_range) value = std::strtof(std::string(digits).c_str(), nullptr);
    if (!std::isfinite(value)) fail(quoted(word) + " is not finite as a float; coordinates must lie within 3.4e38");
    return value;
  }

  void face(Words words) {
    const std::size_t begin = corners_.size();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) corners_.push_back(corner(word));
    if (corners_.size() - begin < 3) fail("a face of fewer than 3 corners; give it 3 or more, or leave it out");
    faces_.push_back({corners_.size(), lines_.number()});
  }

  Index corner(std::string_view word) const {
    std::int64_t index = 0;
    std::string_view rest = word;
    const bool fits = take_integer(rest, index);
    if (rest.size() == word.size() || !is_texture_and_normal(rest))
      fail(quoted(word) + " is no corner of a face; write V, V/VT, V//VN or V/VT/VN");
    if (fits && index == 0) fail(quoted(word) + " names vertex 0; count from 1, or back from -1");
    const std::int64_t vertex = index > 0 ? index - 1 : vertex_count() + index;
    if (!fits || vertex < 0 || vertex > std::numeric_limits<Index>::max())
      fail(quoted(word) + " names no vertex: " + std::to_string(vertex_count()) + " precede it; correct the index");
    return static_cast<Index>(vertex);
  }

  void add_edges(std::span<const Index> corners, std::uint64_t line) {
    const auto& first = bodies_.first;
    for (const Index vertex : corners) {
      if (vertex >= vertex_count())
        fail(line, "a face names vertex " + std::to_string(vertex + std::uint64_t{1}) + " of " +
                       std::to_string(vertex_count()) + "; correct the index");
    }
    const auto next_body = std::upper_bound(first.begin(), first.end(), corners[0]);
    const Index begin = *(next_body - 1), end = *next_body;
    auto& edges = bodies_.edges[static_cast<std::size_t>(next_body - first.begin()) - 1];
    Index previous = corners.back();
    for (const Index vertex : corners) {
      if (vertex < begin || vertex >= end)
        fail(line, "a face across bodies; use the vertices of one object only in a face");
      edges.push_back({previous - begin, vertex - begin});
      previous = vertex;
    }
  }

  std::string name_;
  LineReader lines_;
  ObjBodies bodies_;
  std::vector<Index> corners_;  // of all faces
  std::vector<Face> faces_;
};

}  // namespace

ObjBodies read_obj(const std::filesystem::path& file) {
  try {
    Parser parser(file);
    try {
      return parser.run();
    } catch (const std::length_error& too_long) {
      parser.fail(std::string(too_long.what()) + "; is this a text file in OBJ format?");
    }
  } catch (const std::system_error& error) {
    throw ObjError(file.string() + ": cannot be read: " + error.code().message());
  }
}

}  // namespace app
