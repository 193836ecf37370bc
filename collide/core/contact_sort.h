#pragma once
// Sorts contacts by counting those of each first vertex.

#include "collide/core/points.h"
#include "collide/core/result.h"

namespace collide {

/// Keeps its memory from call to call.
class ContactSort {
 public:
  /// Sorts contacts whose first vertices are among `vertices`.
  void sort(std::vector<Contact>& contacts, Range vertices);
  /// Does the same for contacts of which those of each first vertex are sorted.
  void sort_by_first(std::vector<Contact>& contacts, Range vertices);

 private:
  std::vector<Index> end_;  // of each vertex's contacts
  std::vector<Contact> sorted_;
};

}  // namespace collide
