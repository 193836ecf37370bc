#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "softbody/mesh/limits.h"
#include "softbody/mesh/mesh_parser.h"

namespace softbody {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// The two names of each type, in their order.
constexpr std::array<std::string_view, 16> type_names{"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                                      "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                                      "float",  "float32", "double", "float64"};

bool is_real(Type type) { return type == Type::float32 || type == Type::float64; }

enum class Use { none, x, y, z, corners };

struct Property {
  Type type;
  std::optional<Type> length;  // of a list: the type of its number of items
  Use use;
};

struct Element {
  enum class Kind { vertex, face, tristrips, other };
  std::string name;
  Kind kind;
  std::uint64_t rows;
  std::vector<Property> properties;

  bool has_faces() const { return kind == Kind::face || kind == Kind::tristrips; }
  bool uses(Use use) const { return std::ranges::find(properties, use, &Property::use) != properties.end(); }
};

class PlyParser : public MeshParser {
 public:
  using MeshParser::MeshParser;

  FileMesh run() {
    mesh_.objects.push_back({0, 0, false});
    header();
    words_ = {};
    for (const Element& element : elements_) {
      element_ = &element;
      for (row_ = 0; row_ < element.rows; ++row_) row();
    }
    require_end();
    if (mesh_.x.empty()) throw MeshFileError(name_ + ": no vertex in it; give a PLY file with an element vertex");
    require_vertices();
    return std::move(mesh_);
  }

 private:
  bool text() const { return mesh_.format == FileMesh::Format::ply_text; }

  // ---- header ----

  void header() {
    // CR, LF after the last line is one end or two: if it is two, a binary part begins with the LF.
    const bool cr_alone = lines_.end() == LineReader::End::cr;
    bool has_format = false;
    for (std::string_view line;;) {
      if (!lines_.next(line, cr_alone)) fail_at_line("the file ends before the line 'end_header'; save the file again");
      if (lines_.end() == (cr_alone ? LineReader::End::lf : LineReader::End::cr))
        fail_at_line("ends in " + std::string(cr_alone ? "LF and line 1 in CR" : "CR and line 1 in LF") +
                     "; end all lines of the header alike");
      std::string_view words = line;
      const std::string_view keyword = next_word(words);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format(next_word(words));
        has_format = true;
      } else if (keyword == "element") {
        begin_element(words);
      } else if (keyword == "property") {
        add_property(words);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail_at_line(quoted(keyword) + " begins no line of a PLY header; is this a PLY file?");
      }
    }
    if (!has_format) fail_at_line("the header has no line 'format'; is this a PLY file?");
    for (const Element& element : elements_) require_complete(element);
  }

  void read_format(std::string_view word) {
    mesh_.format = word == "ascii" ? FileMesh::Format::ply_text : FileMesh::Format::ply_binary;
    const bool big = word == "binary_big_endian";
    if (!text() && !big && word != "binary_little_endian")
      fail_at_line(quoted(word) + " is no format; write ascii, binary_little_endian or binary_big_endian");
    foreign_order_ = big != (std::endian::native == std::endian::big);
  }

  void begin_element(std::string_view words) {
    const std::string_view name = next_word(words), count = next_word(words);
    std::uint64_t rows = 0;
    const auto [end, error] = read_number(count, rows);
    if (count.empty() || end != count.data() + count.size() || error != std::errc())
      fail_at_line("an element without the number of its rows; write element NAME COUNT");
    using Kind = Element::Kind;
    const Kind kind = name == "vertex"      ? Kind::vertex
                      : name == "face"      ? Kind::face
                      : name == "tristrips" ? Kind::tristrips
                                            : Kind::other;
    if (kind == Kind::vertex && std::ranges::find(elements_, kind, &Element::kind) != elements_.end())
      fail_at_line("a second element 'vertex'; correct the header");
    if (kind == Kind::vertex && rows > max_particles) fail_at_line(beyond("vertices", max_particles));
    elements_.push_back({std::string(name), kind, rows, {}});
  }

  void add_property(std::string_view words) {
    if (elements_.empty()) fail_at_line("a property before the first element; write element NAME COUNT first");
    Element& element = elements_.back();
    Property property{};
    std::string_view word = next_word(words);
    const bool list = word == "list";
    if (list) {
      property.length = type_of(next_word(words));
      if (is_real(*property.length)) fail_at_line("a list whose length is no whole number; use e.g. uchar");
      word = next_word(words);
    }
    property.type = type_of(word);
    const std::string_view name = next_word(words);
    if (element.kind == Element::Kind::vertex && !list) {
      property.use = name == "x" ? Use::x : name == "y" ? Use::y : name == "z" ? Use::z : Use::none;
    } else if (element.has_faces() && list && (name == "vertex_indices" || name == "vertex_index")) {
      property.use = Use::corners;
      if (element.uses(Use::corners))
        fail_at_line("a second list of the vertices of a face; keep one of vertex_indices and vertex_index");
      if (is_real(property.type)) fail_at_line("indices of vertices that are no whole numbers; use e.g. int");
    }
    element.properties.push_back(property);
  }

  Type type_of(std::string_view word) const {
    const auto* name = std::ranges::find(type_names, word);
    if (name == type_names.end())
      fail_at_line(quoted(word) + " is no type of a property; write e.g. float, int or uchar");
    return static_cast<Type>((name - type_names.begin()) / 2);
  }

  void require_complete(const Element& element) const {
    const auto refuse = [&](const char* what) {
      fail_at_line("the element " + softbody::quoted(element.name) + " has no " + what);
    };
    if (element.properties.empty() && element.rows > 0) refuse("property; correct the header");
    const bool is_vertex = element.kind == Element::Kind::vertex;
    if (is_vertex && (!element.uses(Use::x) || !element.uses(Use::y) || !element.uses(Use::z)))
      refuse("properties x, y and z; correct the header");
    if (element.has_faces() && element.rows > 0 && !element.uses(Use::corners))
      refuse("list vertex_indices; correct the header");
  }

  // ---- rows ----

  [[noreturn]] void fail(const std::string& what) const {
    if (text()) fail_at_line(what);
    fail_at(" element " + softbody::quoted(element_->name) + ", row " + std::to_string(row_) + " (counted from 0)",
            what);
  }

  void row() {
    corners_.clear();
    for (const Property& property : element_->properties) {
      if (!property.length) {
        scalar(property);
        continue;
      }
      const std::int64_t length = integer(*property.length);
      if (length < 0) fail("a list of " + std::to_string(length) + " items; correct the file");
      for (std::int64_t i = 0; i < length; ++i) {
        if (property.use == Use::corners)
          add_corner(integer(property.type));
        else
          skip(property.type);
      }
    }
    if (text() && !next_word(words_).empty()) fail("more numbers than the header says; correct the header or the line");
    using Kind = Element::Kind;
    if (element_->kind == Kind::vertex)
      mesh_.x.push_back(position_[0]), mesh_.y.push_back(position_[1]), mesh_.z.push_back(position_[2]);
    if (element_->kind == Kind::face) add_face(corners_);
    if (element_->kind == Kind::tristrips) add_strips();
  }

  void scalar(const Property& property) {
    if (property.use == Use::none) return skip(property.type);
    position_[static_cast<std::size_t>(property.use) - static_cast<std::size_t>(Use::x)] = real(property.type);
  }

  void add_corner(std::int64_t index) {
    const bool ends_strip = index < 0 && element_->kind == Element::Kind::tristrips;
    if ((index < 0 && !ends_strip) || index >= std::int64_t{no_vertex})
      fail("a face names vertex " + std::to_string(index) + "; correct the index");
    if (mesh_.corners.size() + corners_.size() >= max_file_corners) fail(beyond("corners of faces", max_file_corners));
    corners_.push_back(ends_strip ? no_vertex : static_cast<Index>(index));
  }

  void add_face(std::span<const Index> corners) {
    mesh_.corners.insert(mesh_.corners.end(), corners.begin(), corners.end());
    end_face([&](const std::string& what) { fail(what); });
  }

  /// Adds the triangles of strips, which -1 parts. Triangles without area only lead from one strip to the next.
  void add_strips() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == no_vertex) begin = i + 1;
      if (i < begin + 2) continue;
      const std::size_t odd = (i - begin) % 2;
      const std::array<Index, 3> triangle{corners_[i - 2 + odd], corners_[i - 1 - odd], corners_[i]};
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
      if (mesh_.corners.size() + 3 > max_file_corners) fail(beyond("corners of faces", max_file_corners));
      add_face(triangle);
    }
  }

  /// Refuses what follows the last row.
  void require_end() {
    const std::string what = "the file goes on after the last row of the header's elements; correct the header";
    if (text()) {
      for (std::string_view line; lines_.next(line);)
        if (!next_word(line).empty()) fail_at_line(what);
      return;
    }
    for (std::string_view rest = lines_.bytes(1); !rest.empty(); rest = lines_.bytes(1))
      if (rest[0] != '\n' && rest[0] != '\r' && rest[0] != '\0') throw MeshFileError(name_ + ": " + what);
  }

  // ---- numbers ----

  /// Returns the next word of a text file. A row may continue in the next line.
  std::string_view word() {
    std::string_view next = next_word(words_);
    for (std::string_view line; next.empty(); next = next_word(words_)) {
      if (!lines_.next(line)) fail_truncated();
      words_ = line;
    }
    return next;
  }

  [[noreturn]] void fail_truncated() const {
    fail("the file ends before the last row of the header's elements; save the file again");
  }

  template <class Number>
  Number binary() {
    const std::string_view bytes = lines_.bytes(sizeof(Number));
    if (bytes.empty()) fail_truncated();
    std::array<char, sizeof(Number)> copy;
    std::ranges::copy(bytes, copy.begin());
    if (foreign_order_) std::ranges::reverse(copy);
    return std::bit_cast<Number>(copy);
  }

  /// Returns the next number of a binary file.
  template <class Number>
  Number binary(Type type) {
    if (type == Type::int8) return static_cast<Number>(binary<std::int8_t>());
    if (type == Type::uint8) return static_cast<Number>(binary<std::uint8_t>());
    if (type == Type::int16) return static_cast<Number>(binary<std::int16_t>());
    if (type == Type::uint16) return static_cast<Number>(binary<std::uint16_t>());
    if (type == Type::int32) return static_cast<Number>(binary<std::int32_t>());
    if (type == Type::uint32) return static_cast<Number>(binary<std::uint32_t>());
    if (type == Type::float32) return static_cast<Number>(binary<float>());
    return static_cast<Number>(binary<double>());
  }

  void skip(Type type) {
    if (text())
      word();
    else
      binary<double>(type);
  }

  double real(Type type) {
    if (text()) return number(word());
    const std::optional<double> value = rounded(binary<double>(type));
    if (!value) fail("a coordinate that is " + not_finite());
    return *value;
  }

  std::int64_t integer(Type type) {
    if (!text()) return binary<std::int64_t>(type);
    const std::string_view digits = word();
    std::int64_t value = 0;
    const auto [end, error] = read_number(digits, value);
    if (end != digits.data() + digits.size() || error != std::errc())
      fail_at_line(quoted(digits) + " is no whole number; correct the file");
    return value;
  }

  static constexpr Index no_vertex = ~Index{0};

  std::vector<Element> elements_;
  bool foreign_order_ = false;        // the bytes of a number are reversed
  const Element* element_ = nullptr;  // of the row
  std::uint64_t row_ = 0;
  std::string_view words_;            // the rest of the line
  std::array<double, 3> position_{};  // of the row
  std::vector<Index> corners_;        // of the row; no_vertex ends a strip
};

}  // namespace

FileMesh parse_ply(const std::string& name, LineReader& lines, const MeshReading& reading) {
  return PlyParser(name, lines, reading).run();
}

}  // namespace softbody
