#pragma once
// What the readers of OBJ and PLY files share: words, numbers, limits and messages.

#include <optional>
#include <string>
#include <string_view>

#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/line_reader.h"
#include "softbody/mesh/read_number.h"

namespace softbody {

/// Returns the next word of a line and removes it; empty if there is none. A word that begins with # ends the line.
std::string_view next_word(std::string_view& line);

/// Returns a word of the file for a message: short, and with printable characters only.
std::string quoted(std::string_view word);

/// Parses a number as read_number() does, but allows a + before it.
template <class Real>
std::from_chars_result parse(std::string_view word, Real& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return read_number(word, value);
}

/// Collects the mesh of a file. All members throw MeshFileError.
class MeshParser {
 public:
  /// name: of the file. lines: of the file; it must outlive the parser.
  MeshParser(std::string name, LineReader& lines, const MeshReading& reading)
      : name_(std::move(name)), lines_(lines), reading_(reading) {}

 protected:
  ~MeshParser() = default;

  [[noreturn]] void fail_at(const std::string& place, const std::string& what) const {
    throw MeshFileError(name_ + ":" + place + ": " + what);
  }
  [[noreturn]] void fail_at_line(const std::string& what) const { fail_at(std::to_string(lines_.number()), what); }
  static std::string beyond(const std::string& what, std::uint64_t most) {
    return "more than " + std::to_string(most) + " " + what + "; give a coarser mesh, or a part of it";
  }

  Index vertex_count() const { return static_cast<Index>(mesh_.x.size()); }
  /// Returns a coordinate of the line.
  double number(std::string_view word);
  /// Rounds a coordinate. Returns nothing if it is not finite then.
  std::optional<double> rounded(double value) const;
  std::string not_finite() const {
    return reading_.doubles ? "not finite as a double; coordinates must lie within 1.8e308"
                            : "not finite as a float; coordinates must lie within 3.4e38";
  }
  /// Ends a face whose corners have been added to the mesh. fail(what) throws.
  void end_face(const auto& fail) {
    const std::size_t begin = mesh_.faces.empty() ? 0 : mesh_.faces.back().end;
    if (mesh_.corners.size() - begin < 3) fail("a face of fewer than 3 corners; give it 3 or more, or leave it out");
    mesh_.faces.push_back({mesh_.corners.size(), lines_.number()});
  }
  /// Checks that the vertices of all faces and segments exist. To be called at the end, since these may come before
  /// their vertices.
  void require_vertices() const;

  std::string name_;
  LineReader& lines_;
  MeshReading reading_;
  FileMesh mesh_;
};

/// Reads the statements of an OBJ file, beginning with `line`, which has been read from `lines`.
FileMesh parse_obj(const std::string& name, LineReader& lines, const MeshReading& reading, std::string_view line);
/// Reads a PLY file of which the first line has been read.
FileMesh parse_ply(const std::string& name, LineReader& lines, const MeshReading& reading);

}  // namespace softbody
