#include "softbody/mesh/mesh_parser.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <system_error>

namespace softbody {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

std::string_view Words::next() {
  const char *at = rest_.data(), *const end = at + rest_.size();
  while (at != end && is_space(*at)) ++at;
  if (at != end && *at == '#') at = end;
  const char* const begin = at;
  while (at != end && !is_space(*at)) ++at;
  rest_ = {at, static_cast<std::size_t>(end - at)};
  return {begin, static_cast<std::size_t>(at - begin)};
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 30;
  std::string text(word.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

std::from_chars_result parse(std::string_view word, float& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return std::from_chars(word.data(), word.data() + word.size(), value);
}

float MeshParser::number(std::string_view word) const {
  float value = 0;
  const auto [stop, error] = parse(word, value);
  if (stop != word.data() + word.size() || error == std::errc::invalid_argument)
    fail_at_line(quoted(word) + " is no number; write e.g. -0.25");
  // from_chars does not tell too large from too small to be a float, and leaves the value alone.
  if (error == std::errc::result_out_of_range) value = std::strtof(std::string(word).c_str(), nullptr);
  if (!std::isfinite(value))
    fail_at_line(quoted(word) + " is not finite as a float; coordinates must lie within 3.4e38");
  return value;
}

void MeshParser::require_vertices() const {
  mesh_.for_each_face([&](std::span<const Index> corners, std::size_t face) {
    for (const Index vertex : corners) {
      if (vertex >= vertex_count())
        fail_at(mesh_.place(face), "a face names vertex " +
                                       std::to_string(vertex + std::uint64_t{mesh_.first_number()}) + " of " +
                                       std::to_string(vertex_count()) + "; correct the index");
    }
  });
}

FileMesh read_file_mesh(const std::filesystem::path& file) {
  const std::string name = file.string();
  try {
    LineReader lines(file);
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    try {
      std::string_view line;
      lines.next(line);
      if (Words(line).next() == "ply") return parse_ply(name, lines);
      if (extension == ".ply")
        throw MeshFileError(name + ":1: the line 'ply' is missing; is this a file in PLY format?");
      return parse_obj(name, lines, line);
    } catch (const std::length_error& too_long) {
      throw MeshFileError(name + ":" + std::to_string(lines.number()) + ": " + too_long.what() +
                          "; is this a text file in OBJ or PLY format?");
    }
  } catch (const std::system_error& error) {
    throw MeshFileError(name + ": cannot be read: " + error.code().message());
  }
}

}  // namespace softbody
