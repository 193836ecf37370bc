#pragma once
// How methods are drawn, in the window and in plots, and which ones a user sees side by side.

#include <vector>

#include <glm/vec3.hpp>

#include "collide/methods.h"

namespace app::compare {

/// The mark of a method, for eyes that cannot tell its colour from another. The numbers are gnuplot's.
enum class Marker {
  plus = 1,
  cross = 2,
  star = 3,
  square = 4,
  filled_square = 5,
  circle = 6,
  disc = 7,
  triangle = 8,
  filled_triangle = 9,
  inverted_triangle = 10,
  filled_inverted_triangle = 11,
  diamond = 12,
  filled_diamond = 13,
  pentagon = 14,
  filled_pentagon = 15
};

struct MethodStyle {
  glm::vec3 colour;  // sRGB 0 .. 1
  Marker marker;
  bool shown;  // in comparisons, unless the user chooses otherwise
};

/// Returns the style of a method of the table. Each built-in method has its own. Any further one is shown, with a mark
/// that no built-in one has; fifteen of these differ.
MethodStyle style(const collide::Method& method);

/// Says of each method, by its index in collide::method_table(), whether it is in the set.
using MethodSet = std::vector<bool>;

inline MethodSet all_methods() { return MethodSet(collide::method_table().size(), true); }

/// Adds to `methods` those that the table has beyond its end, if they are shown until the user chooses others.
inline void add_new_methods(MethodSet& methods) {
  for (const collide::Method& method : collide::method_table().subspan(methods.size()))
    methods.push_back(style(method).shown);
}

/// Returns the methods that are shown until the user chooses others.
inline MethodSet usual_methods() {
  MethodSet methods;
  add_new_methods(methods);
  return methods;
}

}  // namespace app::compare
