#pragma once
// Solids in scene files.

#include "softbody/contact/solid.h"
#include "softbody/scene/toml_table.h"
#include "softbody/scene/toml_text.h"

namespace softbody {

/// Reads the solids of a scene file, in the order of Solid::Shape. Throws SceneError.
std::vector<Solid> read_solids(Table& root);
void write_solids(TomlLines& out, std::vector<Solid> solids);

}  // namespace softbody
