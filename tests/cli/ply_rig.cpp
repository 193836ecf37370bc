#include "tests/cli/ply_rig.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace cli::test {
namespace {

template <class Number>
std::string bytes_of(double value, bool big) {
  using Cast = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;  // indices wrap around
  const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(static_cast<Number>(static_cast<Cast>(value)));
  std::string text(bytes.begin(), bytes.end());
  if (big != (std::endian::native == std::endian::big)) std::ranges::reverse(text);
  return text;
}

}  // namespace

std::vector<PlyForm> ply_forms() {
  std::vector<PlyForm> forms;
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* real : {"float", "float64"})
      for (const bool extras : {false, true}) forms.push_back({format, real, "uchar", "int", extras, extras});
    for (const char* integer : {"char", "uint8", "short", "ushort", "int32", "uint"})
      forms.push_back({format, "double", integer, integer, true, false});
  }
  return forms;
}

std::string text_of(const PlyForm& form) {
  return form.format + ", " + form.real + ", list " + form.length + " " + form.index + (form.extras ? ", extras" : "");
}

std::string ply_number(const PlyForm& form, const std::string& type, double value) {
  const bool big = form.format == "binary_big_endian";
  if (form.format == "ascii") return fmt::format("{:.17g} ", value);
  if (type == "char" || type == "int8") return bytes_of<std::int8_t>(value, big);
  if (type == "uchar" || type == "uint8") return bytes_of<std::uint8_t>(value, big);
  if (type == "short" || type == "int16") return bytes_of<std::int16_t>(value, big);
  if (type == "ushort" || type == "uint16") return bytes_of<std::uint16_t>(value, big);
  if (type == "int" || type == "int32") return bytes_of<std::int32_t>(value, big);
  if (type == "uint" || type == "uint32") return bytes_of<std::uint32_t>(value, big);
  return type == "float" || type == "float32" ? bytes_of<float>(value, big) : bytes_of<double>(value, big);
}

std::string ply(const std::vector<std::array<float, 3>>& vertices, const std::vector<std::vector<unsigned>>& faces,
                const PlyForm& form) {
  const auto number = [&](const std::string& type, double value) { return ply_number(form, type, value); };
  const std::string row_end = form.format == "ascii" ? "\n" : "", red = form.extras ? "property uchar red\n" : "",
                    list = "property list " + form.length + " " + form.index + " vertex_indices\n";
  std::string vertex_head = fmt::format("element vertex {}\nproperty {} x\n", vertices.size(), form.real) + red;
  vertex_head += "property " + form.real + " y\nproperty " + form.real + " z\n";
  std::string face_head = fmt::format("element face {}\n", faces.size()) + red + list;
  std::string vertex_rows, face_rows;
  for (const auto& [x, y, z] : vertices)
    vertex_rows += number(form.real, x) + (form.extras ? number("uchar", 255) : "") + number(form.real, y) +
                   number(form.real, z) + row_end;
  for (const auto& face : faces) {
    if (form.extras) face_rows += number("uchar", 7);
    face_rows += number(form.length, static_cast<double>(face.size()));
    for (const unsigned corner : face) face_rows += number(form.index, corner);
    if (form.extras) face_rows += number("uint", 2) + number("double", -1.5) + number("double", 0.25);
    face_rows += row_end;
  }
  std::string other_head, other_rows;
  if (form.extras) {
    face_head += "property list uint double texcoord\n";
    other_head = "element edge 2\nproperty int vertex1\nproperty list uchar short vertex_indices\n";
    other_rows = number("int", 3) + number("uchar", 0) + row_end + number("int", 1) + number("uchar", 1) +
                 number("short", -9) + row_end;
  }
  const std::string head = "ply\nformat " + form.format + " 1.0\ncomment written by a test \\\nobj_info # nothing\n";
  const std::string end = "end_header\n";
  if (form.faces_first) return head + face_head + other_head + vertex_head + end + face_rows + other_rows + vertex_rows;
  return head + vertex_head + other_head + face_head + end + vertex_rows + other_rows + face_rows;
}

}  // namespace cli::test
