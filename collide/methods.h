#pragma once
// The one table of detectors. Command line, panel, reports and tests loop over it; nothing else lists the methods.

#include <memory>
#include <string_view>

#include "collide/core/detector.h"

namespace collide {

struct Method {
  std::string_view key;      // on the command line and in scene files
  std::string_view name;     // in the panel
  std::string_view summary;  // one sentence with its paper section
  glm::vec3 colour;          // sRGB 0 .. 1, told apart by colour-blind eyes
  bool exact;                // cannot miss a contact
  bool uses_levels;          // has use for Settings::levels
  bool uses_hash;            // has use for buckets, cell_size, primes
  std::unique_ptr<Detector> (*make)();
};

std::span<const Method> method_table();
/// nullptr if there is no such method.
const Method* find_method(std::string_view key);
/// "brute-force, grid-hash, ...": for messages.
std::string method_keys();

inline constexpr std::string_view default_method = "multi-level-sb-exact";
/// The method as the paper has it.
inline constexpr std::string_view paper_method = "multi-level-sb";
/// The method whose contacts are the true ones by definition.
inline constexpr std::string_view reference_method = "brute-force";

}  // namespace collide
