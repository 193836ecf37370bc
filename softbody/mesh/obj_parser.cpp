#include <array>
#include <limits>
#include <system_error>

#include "softbody/mesh/limits.h"
#include "softbody/mesh/mesh_parser.h"

namespace softbody {
namespace {

/// Reads an integer at the start of `text` and removes it. Returns false if there is none or it is too large.
bool take_integer(std::string_view& text, std::int64_t& number) {
  const auto [end, error] = read_number(text, number);
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

class ObjParser : public MeshParser {
 public:
  using MeshParser::MeshParser;

  FileMesh run(std::string_view line) {
    do {
      statement(line);
    } while (lines_.next(line));
    if (mesh_.objects.empty() || (mesh_.x.empty() && passed_over_))
      throw MeshFileError(name_ + ": no vertex in it; give a Wavefront OBJ file with lines such as v 0 0 0");
    require_vertices();
    return std::move(mesh_);
  }

 private:
  void statement(std::string_view words) {
    const std::string_view keyword = next_word(words);
    if (keyword == "v") return vertex(words);
    if (keyword == "f") return face(words);
    if (keyword == "l" && reading_.lines) return line(words);
    if (keyword == "o") return begin_object(true);
    if (keyword.empty()) return;
    const char initial = keyword.front();
    if (!((initial >= 'a' && initial <= 'z') || (initial >= 'A' && initial <= 'Z')))
      fail_at_line(quoted(keyword) + " begins no OBJ statement; is this a text file in OBJ format?");
    passed_over_ = true;
  }

  void begin_object(bool named) {
    if (mesh_.objects.size() == max_particles) fail_at_line(beyond("objects", max_particles));
    mesh_.objects.push_back({vertex_count(), mesh_.faces.size(), named});
  }

  void vertex(std::string_view words) {
    if (mesh_.objects.empty()) begin_object(false);
    if (vertex_count() == max_particles) fail_at_line(beyond("vertices", max_particles));
    std::array<double, 3> position;
    for (double& coordinate : position) {
      const std::string_view word = next_word(words);
      if (word.empty()) fail_at_line("a vertex with fewer than 3 coordinates; write v X Y Z");
      coordinate = number(word);
    }
    mesh_.x.push_back(position[0]);
    mesh_.y.push_back(position[1]);
    mesh_.z.push_back(position[2]);
    pass_over_weight_and_colour(words);
  }

  /// Skips a weight and a colour, whatever their values, such as 1.#QNAN. Anything else after a vertex, such as a
  /// second vertex, is an error, since it must not be lost.
  void pass_over_weight_and_colour(std::string_view words) {
    int count = 0;
    bool is_one = true;
    for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
      float value = 0;
      const char *const stop = parse(word, value).ptr, *const end = word.data() + word.size();
      if (stop == word.data() || (stop != end && *stop != '#'))
        fail_at_line(quoted(word) + " is no number; write v X Y Z");
      if (++count > 4) fail_at_line("a vertex with more than 7 numbers; write v X Y Z");
      is_one = stop == end && value == 1;
    }
    if (count == 1 && !is_one) ++mesh_.weights;
  }

  void face(std::string_view words) {
    for (std::string_view word = next_word(words); !word.empty(); word = next_word(words))
      mesh_.corners.push_back(corner(word));
    if (mesh_.corners.size() > max_file_corners) fail_at_line(beyond("corners of faces", max_file_corners));
    end_face([&](const std::string& what) { fail_at_line(what); });
  }

  void line(std::string_view words) {
    std::string_view word = next_word(words);
    if (word.empty()) fail_at_line("a line without a vertex; write l V V");
    for (Index last = corner(word); !(word = next_word(words)).empty();) {
      const Index next = corner(word);
      mesh_.segments.push_back({last, next, lines_.number()});
      if (mesh_.segments.size() > max_file_corners) fail_at_line(beyond("segments of lines", max_file_corners));
      last = next;
    }
  }

  Index corner(std::string_view word) const {
    std::int64_t index = 0;
    std::string_view rest = word;
    const bool fits = take_integer(rest, index);
    if (rest.size() == word.size() || !is_texture_and_normal(rest))
      fail_at_line(quoted(word) + " is no corner of a face; write V, V/VT, V//VN or V/VT/VN");
    if (fits && index == 0) fail_at_line(quoted(word) + " names vertex 0; count from 1, or back from -1");
    const std::int64_t vertex = index > 0 ? index - 1 : vertex_count() + index;
    if (!fits || vertex < 0 || vertex > std::numeric_limits<Index>::max())
      fail_at_line(quoted(word) + " names no vertex: " + std::to_string(vertex_count()) +
                   " precede it; correct the index");
    return static_cast<Index>(vertex);
  }

  bool passed_over_ = false;  // a statement
};

}  // namespace

FileMesh parse_obj(const std::string& name, LineReader& lines, const MeshReading& reading, std::string_view line) {
  return ObjParser(name, lines, reading).run(line);
}

}  // namespace softbody
