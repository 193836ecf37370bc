#include "softbody/scene/solid_toml.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace softbody {
namespace {

constexpr Key::Limits places = solid::PlaceKind::limits, lengths = solid::LengthKind::limits;

constexpr double unit_error = 1e-14;  // of the square of a length that was made 1, at most

/// Reads a rotation as a matrix, column by column. Saved scenes use this form, since it is exact.
glm::dmat3 read_axes(Table table) {
  const glm::dmat3 axes = table.matrix("axes");
  table.close();
  if (!solid::is_valid(axes))
    table.fail("axes", "must be three directions of length 1, each at right angles to the others, right-handed");
  return axes;
}

}  // namespace

glm::dvec3 read_direction(Table& table, const std::string& key, const glm::dvec3& fallback) {
  const glm::dvec3 v = table.vector(key, fallback, places.least, places.most);
  if (glm::length(v) < lengths.least) table.fail(key, "must have a length, e.g. [0, 1, 0]");
  return std::abs(glm::dot(v, v) - 1) < unit_error ? v : glm::normalize(v);
}

glm::dmat3 read_rotation(Table table) {
  if (table.has("axes")) return read_axes(std::move(table));
  const glm::dvec3 axis = read_direction(table, "axis", {0, 1, 0});
  const double angle = glm::radians(table.number("degrees", 0, -360, 360));
  table.close();
  constexpr double digits = 1e12;
  const double s = std::round(std::sin(angle) * digits) / digits, c = std::round(std::cos(angle) * digits) / digits;
  glm::dmat3 columns;
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 e(0.0);
    e[k] = 1;
    columns[k] = c * e + s * glm::cross(axis, e) + (1 - c) * glm::dot(axis, e) * axis;
  }
  return columns;
}

namespace {

struct ShapeReader {
  Table& table;
  void operator()(const std::string& key, solid::Place p) const {
    p.value = table.vector(key, p.value, places.least, places.most);
  }
  template <class Kind>
  void operator()(const std::string& key, solid::Value<Kind, double> v) const {
    v.value = table.number(key, v.value, Kind::limits.least, Kind::limits.most);
  }
  void operator()(const std::string& key, solid::HalfSize s) const {
    s.value = 0.5 * table.vector(key, 2.0 * s.value, lengths.least, lengths.most);
  }
  void operator()(const std::string& key, solid::Direction d) const { d.value = read_direction(table, key, d.value); }
  void operator()(const std::string& key, solid::Axes a) const { a.value = read_rotation(table.child(key)); }
};

template <class Out>
struct ShapeWriter {
  Out& out;
  void operator()(std::string_view key, auto v) const { out.add(key, v.value); }
  void operator()(std::string_view key, solid::HalfSize s) const { out.add(key, 2.0 * s.value); }
  void operator()(std::string_view key, solid::Axes a) const { write_rotation(out, key, a.value); }
};

template <class Shape>
void read_all(Table& root, std::vector<Solid>& solids) {
  const std::string key(Shape::traits.key);
  const auto read = [&solids](Table table) {
    Solid& s = solids.emplace_back(Solid{Shape{}});
    s.values(ShapeReader{table});
    s.friction = table.number("friction", s.friction, s.friction_limits.least, s.friction_limits.most);
    s.restitution = table.number("restitution", s.restitution, s.restitution_limits.least, s.restitution_limits.most);
    s.enabled = table.boolean("enabled", s.enabled);
    table.close();
  };
  if (!Shape::traits.single)
    for (const Table& table : root.children(key)) read(table);
  else if (root.has(key))
    read(root.child(key));
}

template <class... Shapes>
void read_each(Table& root, std::vector<Solid>& solids, const std::variant<Shapes...>&) {
  (read_all<Shapes>(root, solids), ...);
}

}  // namespace

std::vector<Solid> read_solids(Table& root) {
  std::vector<Solid> solids;
  read_each(root, solids, Solid::Shape());
  return solids;
}

Solid::Shape read_shape(Table table, Solid::Shape shape) {
  std::visit([&](auto& one) { one.values(ShapeReader{table}); }, shape);
  table.close();
  return shape;
}

TomlInline write_shape(Solid::Shape shape) {
  TomlInline out;
  std::visit([&](auto& one) { one.values(ShapeWriter<TomlInline>{out}); }, shape);
  return out;
}

void write_solids(TomlLines& out, std::vector<Solid> solids) {
  for (Solid& s : solids) {
    const auto& [key, name, friction, half_space, single] = s.traits();
    std::string heading(single ? "[" : "[[");
    out.heading(heading.append(key).append(single ? "]" : "]]"));
    s.values(ShapeWriter<TomlLines>{out});
    out.add("friction", s.friction).add("restitution", s.restitution);
    if (!s.enabled) out.add("enabled", false);
  }
}

}  // namespace softbody
