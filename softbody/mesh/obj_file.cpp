#include "softbody/mesh/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

#include "softbody/mesh/limits.h"
#include "softbody/mesh/line_reader.h"

namespace softbody {
namespace {

/// Splits a line into words. A word that begins with # ends the line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// Returns the next word; empty if there is none.
  std::string_view next() {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; };
    const char *at = rest_.data(), *const end = at + rest_.size();
    while (at != end && is_space(*at)) ++at;
    if (at != end && *at == '#') at = end;
    const char* const begin = at;
    while (at != end && !is_space(*at)) ++at;
    rest_ = {at, static_cast<std::size_t>(end - at)};
    return {begin, static_cast<std::size_t>(at - begin)};
  }

 private:
  std::string_view rest_;
};

/// Returns a word of the file for a message: short, and with printable characters only.
std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 30;
  std::string text(word.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

/// Reads an integer at the start of `text` and removes it. Returns false if there is none or it is too large.
bool take_integer(std::string_view& text, std::int64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc();
}

/// True for "", "/vt", "//vn" and "/vt/vn"; the numbers may be missing.
bool is_texture_and_normal(std::string_view text) {
  std::int64_t ignored = 0;
  for (int part = 0; part < 2 && text.starts_with('/'); ++part) {
    text.remove_prefix(1);
    take_integer(text, ignored);
  }
  return text.empty();
}

/// Parses a number as from_chars() does, but allows a + before it.
std::from_chars_result parse(std::string_view word, float& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return std::from_chars(word.data(), word.data() + word.size(), value);
}

class Parser {
 public:
  explicit Parser(const std::filesystem::path& file) : name_(file.string()), lines_(file) {}

  ObjFile run() {
    std::string_view line;
    while (lines_.next(line)) {
      if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF")) fail("is UTF-16; save it as UTF-8");
      if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
      statement(Words(line));
    }
    if (file_.objects.empty() || (file_.x.empty() && passed_over_))
      throw ObjError(name_ + ": no vertex in it; give a Wavefront OBJ file with lines such as v 0 0 0");
    file_.for_each_face([&](std::span<const Index> corners, std::uint64_t at) { require_vertices(corners, at); });
    return std::move(file_);
  }

  [[noreturn]] void fail(const std::string& what) const { fail(lines_.number(), what); }

 private:
  [[noreturn]] void fail(std::uint64_t line, const std::string& what) const {
    throw ObjError(name_ + ":" + std::to_string(line) + ": " + what);
  }

  static std::string beyond(const std::string& what, std::uint64_t most) {
    return "more than " + std::to_string(most) + " " + what + "; give a coarser mesh, or a part of it";
  }

  Index vertex_count() const { return static_cast<Index>(file_.x.size()); }

  void statement(Words words) {
    const std::string_view keyword = words.next();
    if (keyword == "v") return vertex(words);
    if (keyword == "f") return face(words);
    if (keyword == "o") return begin_object(true);
    if (keyword.empty()) return;
    const char initial = keyword.front();
    if (!((initial >= 'a' && initial <= 'z') || (initial >= 'A' && initial <= 'Z')))
      fail(quoted(keyword) + " begins no OBJ statement; is this a text file in OBJ format?");
    passed_over_ = true;
  }

  void begin_object(bool named) {
    if (file_.objects.size() == max_particles) fail(beyond("objects", max_particles));
    file_.objects.push_back({vertex_count(), file_.faces.size(), named});
  }

  void vertex(Words words) {
    if (file_.objects.empty()) begin_object(false);
    if (vertex_count() == max_particles) fail(beyond("vertices", max_particles));
    std::array<float, 3> position;
    for (float& coordinate : position) coordinate = number(words.next());
    file_.x.push_back(position[0]);
    file_.y.push_back(position[1]);
    file_.z.push_back(position[2]);
    pass_over_weight_and_colour(words);
  }

  /// Skips a weight and a colour, whatever their values, such as 1.#QNAN. Anything else after a vertex, such as a
  /// second vertex, is an error, since it must not be lost.
  void pass_over_weight_and_colour(Words words) {
    int count = 0;
    bool is_one = true;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      float value = 0;
      const char *const stop = parse(word, value).ptr, *const end = word.data() + word.size();
      if (stop == word.data() || (stop != end && *stop != '#')) fail(quoted(word) + " is no number; write v X Y Z");
      if (++count > 4) fail("a vertex with more than 7 numbers; write v X Y Z");
      is_one = stop == end && value == 1;
    }
    if (count == 1 && !is_one) ++file_.weights;
  }

  float number(std::string_view word) const {
    if (word.empty()) fail("a vertex with fewer than 3 coordinates; write v X Y Z");
    float value = 0;
    const auto [stop, error] = parse(word, value);
    if (stop != word.data() + word.size() || error == std::errc::invalid_argument)
      fail(quoted(word) + " is no number; write e.g. -0.25");
    // from_chars does not tell too large from too small to be a float, and leaves the value alone.
    if (error == std::errc::result_out_of_range) value = std::strtof(std::string(word).c_str(), nullptr);
    if (!std::isfinite(value)) fail(quoted(word) + " is not finite as a float; coordinates must lie within 3.4e38");
    return value;
  }

  void face(Words words) {
    const std::size_t begin = file_.corners.size();
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      file_.corners.push_back(corner(word));
    if (file_.corners.size() > max_file_corners) fail(beyond("corners of faces", max_file_corners));
    if (file_.corners.size() - begin < 3) fail("a face of fewer than 3 corners; give it 3 or more, or leave it out");
    file_.faces.push_back({file_.corners.size(), lines_.number()});
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

  /// Checks that a face's vertices exist. Called at the end of the file, since a face may come before its vertices.
  void require_vertices(std::span<const Index> corners, std::uint64_t line) const {
    for (const Index vertex : corners) {
      if (vertex >= vertex_count())
        fail(line, "a face names vertex " + std::to_string(vertex + std::uint64_t{1}) + " of " +
                       std::to_string(vertex_count()) + "; correct the index");
    }
  }

  std::string name_;
  LineReader lines_;
  ObjFile file_;
  bool passed_over_ = false;  // a statement
};

}  // namespace

ObjFile read_obj_file(const std::filesystem::path& file) {
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

}  // namespace softbody
