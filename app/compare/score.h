#pragma once
// What a method found, held against the true contacts.

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "collide/core/detector.h"

namespace app {

struct Score {
  std::vector<collide::Contact> missed;  // false negatives
  double recall = 1;                     // found true contacts / all true contacts; 1 if there are none
  double precision = 1;                  // found true contacts / all found; 1 if none is found
};

/// Both lists ascending and without duplicates, as detectors give them.
inline Score score(std::span<const collide::Contact> found, std::span<const collide::Contact> truth) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  Score result;
  std::ranges::set_difference(truth, found, std::back_inserter(result.missed));
  const std::size_t hits = truth.size() - result.missed.size();
  result.recall = share(hits, truth.size());
  result.precision = share(hits, found.size());
  return result;
}

}  // namespace app
