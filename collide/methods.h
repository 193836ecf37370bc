#pragma once
// The one table of detectors. Command line, panel, reports, documents and tests loop over it; nothing else lists the
// methods.

#include <memory>
#include <string_view>

#include "collide/core/detector.h"

namespace collide {

/// Methods that are shown together. They stand together in the table, too.
enum class MethodGroup { rivals, paper, sorted, trees };
struct MethodGroupName {
  MethodGroup group;
  std::string_view name;
};
inline constexpr std::array<MethodGroupName, 4> method_groups{{{MethodGroup::rivals, "The paper's rivals"},
                                                               {MethodGroup::paper, "The paper's method"},
                                                               {MethodGroup::sorted, "Sorted grids and sweeps"},
                                                               {MethodGroup::trees, "Trees"}}};

/// The mark of a method in plots, for eyes that cannot tell its colour from another. The numbers are gnuplot's.
enum class Marker {
  plus = 1,
  cross = 2,
  square = 4,
  filled_square = 5,
  circle = 6,
  disc = 7,
  triangle = 8,
  filled_triangle = 9,
  filled_inverted_triangle = 11,
  diamond = 12,
  filled_diamond = 13,
  filled_pentagon = 15
};

struct Method {
  std::string_view key;      // on the command line and in scene files
  std::string_view name;     // in the panel
  std::string_view summary;  // one sentence with its paper section
  // What it is, when to choose it, its cost for n vertices, whether it rebuilds or refits, and its source: a paragraph
  // of the panel and of collide/README.md.
  std::string_view description;
  MethodGroup group;
  bool shown;        // in comparisons, unless the user chooses otherwise
  glm::vec3 colour;  // sRGB 0 .. 1
  Marker marker;     // no two methods have the same
  bool exact;        // cannot miss a contact
  bool uses_levels;  // has use for Settings::levels
  bool uses_hash;    // has use for buckets, cell_size, primes
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
