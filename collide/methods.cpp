#include "collide/methods.h"

#include <algorithm>

#include "collide/exact/multi_level_sb_exact.h"
#include "collide/methods/detectors.h"

namespace collide {

namespace {

/// Okabe and Ito's palette: colours that colour-blind eyes tell apart.
constexpr glm::vec3 rgb(int red, int green, int blue) {
  return glm::vec3(static_cast<float>(red) / 255, static_cast<float>(green) / 255, static_cast<float>(blue) / 255);
}

// key, name, summary, colour, exact, uses_levels, uses_hash, make
constexpr std::array table{
    Method{"brute-force", "Brute force", "Tests every vertex against every other: the exact reference.",
           rgb(153, 153, 153), true, false, false, methods::make_brute_force},
    Method{"grid-hash", "Grid Hash", "Hashes every vertex into a grid, without boxes (§3).", rgb(213, 94, 0), true,
           false, true, methods::make_grid_hash},
    Method{"bounding-box", "Bounding Box", "Tests all vertices of bodies whose boxes overlap (§3).", rgb(230, 159, 0),
           true, false, false, methods::make_bounding_box},
    Method{"bounding-box-grid-hash", "Bounding Box + Grid Hash",
           "Hashes only the vertices of bodies whose boxes overlap (§3).", rgb(204, 121, 167), true, false, true,
           methods::make_bounding_box_grid_hash},
    Method{"multi-level-sb", "Multi-Level SB",
           "The paper's method: hashes the eight corners of each subdivided box (§2). It can miss contacts.",
           rgb(86, 180, 233), false, true, true, methods::make_multi_level_sb},
    Method{"multi-level-sb-exact", "Multi-Level SB, exact",
           "Searches only where bodies face each other, without a hash (§2.1, §5). It misses nothing.",
           rgb(0, 158, 115), true, true, false, exact::make_multi_level_sb_exact},
};

}  // namespace

std::span<const Method> method_table() { return table; }

const Method* find_method(std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Method& method) { return method.key == key; });
  return found == table.end() ? nullptr : &*found;
}

std::string method_keys() {
  std::string keys;
  for (const Method& method : table) keys.append(keys.empty() ? "" : ", ").append(method.key);
  return keys;
}

}  // namespace collide
