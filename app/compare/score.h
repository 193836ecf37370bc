#pragma once
// Compares the contacts that a method found with the true ones.

#include <algorithm>
#include <cassert>
#include <iterator>
#include <span>
#include <vector>

#include "collide/core/detector.h"

namespace app::compare {

struct Score {
  std::vector<collide::Contact> missed;  // false negatives
  double recall = 1;                     // found true contacts / all true contacts; 1 if there are none
  double precision = 1;                  // found true contacts / all found contacts; 1 if none is found
};

/// Returns part / whole; 1 if there is nothing.
inline double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Returns the score of `found`. Precondition: both lists are ascending and without duplicates, as detectors return
/// them.
inline Score score(std::span<const collide::Contact> found, std::span<const collide::Contact> truth) {
  assert(std::ranges::is_sorted(found) && std::ranges::is_sorted(truth));
  Score result;
  std::ranges::set_difference(truth, found, std::back_inserter(result.missed));
  const std::size_t hits = truth.size() - result.missed.size();
  result.recall = share(hits, truth.size());
  result.precision = share(hits, found.size());
  return result;
}

}  // namespace app::compare
