#pragma once
// Sets of methods: which ones a user sees side by side.

#include <vector>

#include "collide/methods.h"

namespace app::compare {

/// Says of each method, by its index in collide::method_table(), whether it is in the set.
using MethodSet = std::vector<bool>;

inline MethodSet all_methods() { return MethodSet(collide::method_table().size(), true); }

/// Returns the methods that are shown until the user chooses others.
inline MethodSet usual_methods() {
  MethodSet methods;
  for (const collide::Method& method : collide::method_table()) methods.push_back(method.shown);
  return methods;
}

}  // namespace app::compare
