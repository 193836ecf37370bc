#pragma once
// The one table of detectors. Command line, panel, reports, documents and tests loop over it. It can grow while the
// program runs.

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "collide/core/detector.h"

namespace collide {

/// Methods that are shown together. They stand together in the table, too.
enum class MethodGroup { rivals, paper, sorted, trees, guests };
struct MethodGroupName {
  MethodGroup group;
  std::string_view name;
};
/// A group may be empty.
inline constexpr std::array<MethodGroupName, 5> method_groups{{{MethodGroup::rivals, "The paper's rivals"},
                                                               {MethodGroup::paper, "The paper's method"},
                                                               {MethodGroup::sorted, "Sorted grids and sweeps"},
                                                               {MethodGroup::trees, "Trees"},
                                                               {MethodGroup::guests, "Your own methods"}}};

/// Which pairs of vertices a method without a hash tests.
enum class PairTests { all, of_near_bodies, of_near_vertices };

/// A row owns its texts, so that a program can make one while it runs.
struct Method {
  std::string key;      // on the command line and in scene files
  std::string name;     // in the panel
  std::string summary;  // one sentence with its paper section
  // What it is, when to choose it, its cost for n vertices, whether it rebuilds or refits, and its source: a paragraph
  // of the panel and of collide/README.md.
  std::string description;
  MethodGroup group;
  bool exact = true;         // cannot miss a contact
  bool uses_levels = false;  // has use for Settings::levels
  bool uses_hash = false;    // has use for buckets, cell_size, primes
  PairTests tests = PairTests::of_near_vertices;
  std::function<std::unique_ptr<Detector>()> make;

  /// Returns false for a method that is only compared with others: it may fail at any time.
  bool can_drive() const { return group != MethodGroup::guests; }
};

inline constexpr std::size_t max_methods = 64;

/// Returns all rows. A row keeps its place, and its index, to the end of the program.
std::span<const Method> method_table();
/// Adds a row, whose key must be new, at the end. Other threads may read the table meanwhile. Throws std::length_error
/// beyond max_methods.
void add_method(Method row);
/// nullptr if there is no such method.
const Method* find_method(std::string_view key);
/// nullptr if there is no such method that can drive bodies.
const Method* find_driver(std::string_view key);
/// "brute-force, grid-hash, ...", all that can drive bodies: for messages.
std::string method_keys();

inline constexpr std::string_view default_method = "multi-level-sb-exact";
/// The method as the paper has it.
inline constexpr std::string_view paper_method = "multi-level-sb";
/// The method whose contacts are the true ones by definition.
inline constexpr std::string_view reference_method = "brute-force";

}  // namespace collide
