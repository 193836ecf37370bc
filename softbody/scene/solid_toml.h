#pragma once
// Solids in scene files.

#include "softbody/contact/solid.h"
#include "softbody/scene/toml_table.h"
#include "softbody/scene/toml_text.h"

namespace softbody {

/// Reads the solids of a scene file, in the order of Solid::Shape. Throws SceneError.
std::vector<Solid> read_solids(Table& root);
void write_solids(TomlLines& out, std::vector<Solid> solids);

// What bodies have in common with solids. They throw SceneError, too.
/// Reads a direction of any length but zero and returns its unit vector. A unit vector is returned unchanged, to the
/// bit, so that saved scenes are equal.
glm::dvec3 read_direction(Table& table, const std::string& key, const glm::dvec3& fallback);
/// Returns the matrix that rotates by `degrees` about `axis`, counter-clockwise as seen from its tip (Rodrigues). Sine
/// and cosine are rounded, so that quarter turns are exact and processors agree in the last digits.
glm::dmat3 read_rotation(Table table);
/// Writes a rotation as a matrix, column by column, unless there is none.
void write_rotation(auto& out, std::string_view key, const glm::dmat3& axes) {
  if (axes != glm::dmat3(1.0)) out.add(key, TomlInline().add("axes", axes));
}
/// Reads the values of a shape. A key that is missing leaves its value as it is.
Solid::Shape read_shape(Table table, Solid::Shape shape);
TomlInline write_shape(Solid::Shape shape);

}  // namespace softbody
