#include "collide/methods.h"

#include <algorithm>

#include "collide/detectors.h"

namespace collide {

namespace {

/// Okabe and Ito's palette: colours that colour-blind eyes tell apart.
constexpr glm::vec3 rgb(int red, int green, int blue) {
  return glm::vec3(static_cast<float>(red) / 255, static_cast<float>(green) / 255, static_cast<float>(blue) / 255);
}

// key, name, summary, colour, exact, uses_levels, uses_hash, make
constexpr std::array table{
    Method{"brute-force", "Brute force", "Every vertex against every other: the exact reference.", rgb(153, 153, 153),
           true, false, false, make_brute_force},
};

}  // namespace

std::span<const Method> methods() { return table; }

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
