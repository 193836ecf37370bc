#include "softbody/mesh/mesh_parser.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>

#include <glm/common.hpp>

namespace softbody {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

std::string_view next_word(std::string_view& line) {
  const char *at = line.data(), *const end = at + line.size();
  while (at != end && is_space(*at)) ++at;
  if (at != end && *at == '#') at = end;
  const char* const begin = at;
  while (at != end && !is_space(*at)) ++at;
  line = {at, static_cast<std::size_t>(end - at)};
  return {begin, static_cast<std::size_t>(at - begin)};
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 30;
  std::string text(word.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

double MeshParser::number(std::string_view word) {
  int digits = 0;
  for (const char c : word.substr(0, word.find_first_of("eE")))
    if (c >= (digits > 0 ? '0' : '1') && c <= '9') ++digits;
  mesh_.digits = std::max(mesh_.digits, digits);
  const auto read = [&](auto value, auto from_text) {
    const auto [stop, error] = parse(word, value);
    if (stop != word.data() + word.size() || error == std::errc::invalid_argument)
      fail_at_line(quoted(word) + " is no number; write e.g. -0.25");
    // read_number() does not tell too large from too small, and leaves the value alone.
    if (error == std::errc::result_out_of_range) value = from_text(std::string(word).c_str(), nullptr);
    if (!std::isfinite(value)) fail_at_line(quoted(word) + " is " + not_finite());
    return double{value};
  };
  return reading_.doubles ? read(0.0, std::strtod) : read(0.0f, std::strtof);
}

std::optional<double> MeshParser::rounded(double value) const {
  const double most = reading_.doubles ? std::numeric_limits<double>::max() : double{std::numeric_limits<float>::max()};
  if (!(std::abs(value) <= most)) return std::nullopt;
  return reading_.doubles ? value : double{static_cast<float>(value)};
}

void MeshParser::require_vertices() const {
  const auto refuse = [&](Index vertex, const std::string& place, const char* feature) {
    fail_at(place, feature + (" names vertex " + std::to_string(vertex + std::uint64_t{mesh_.first_number()})) +
                       " of " + std::to_string(vertex_count()) + "; correct the index");
  };
  mesh_.for_each_face([&](std::span<const Index> corners, std::size_t face) {
    for (const Index vertex : corners)
      if (vertex >= vertex_count()) refuse(vertex, mesh_.place(face), "a face");
  });
  for (const FileMesh::Segment& segment : mesh_.segments)
    for (const Index vertex : {segment.a, segment.b})
      if (vertex >= vertex_count()) refuse(vertex, std::to_string(segment.line), "a line");
}

glm::dvec3 origin_near(const glm::dvec3& lo, const glm::dvec3& hi) {
  const glm::dvec3 half = 0.5 * hi - 0.5 * lo;
  int exponent = 0;
  std::frexp(std::max({half.x, half.y, half.z}), &exponent);
  const double step = std::ldexp(1.0, std::clamp(exponent + 2, -900, 1000));
  return step * glm::round((0.5 * lo + 0.5 * hi) / step);
}

FileMesh read_file_mesh(const std::filesystem::path& file, const MeshReading& reading) {
  const std::string name = file.string();
  try {
    LineReader lines(file);
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    try {
      std::string_view line;
      lines.next(line);
      if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF"))
        throw MeshFileError(name + ":1: is UTF-16; save it as UTF-8");
      std::string_view rest = line;
      if (next_word(rest) == "ply") return parse_ply(name, lines, reading);
      if (extension == ".ply")
        throw MeshFileError(name + ":1: the line 'ply' is missing; is this a file in PLY format?");
      return parse_obj(name, lines, reading, line);
    } catch (const std::length_error& too_long) {
      throw MeshFileError(name + ":" + std::to_string(lines.number()) + ": " + too_long.what() +
                          "; is this a text file in OBJ or PLY format?");
    }
  } catch (const std::system_error& error) {
    throw MeshFileError(name + ": cannot be read: " + error.code().message());
  }
}

}  // namespace softbody
