#pragma once
// What a method takes and finds on a frame: its time, and its contacts beside the true ones.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "app/base/timings.h"
#include "collide/core/detector.h"

namespace app::compare {

struct Score {
  std::vector<collide::Contact> missed;         // false negatives
  std::optional<collide::Contact> first_false;  // the first false positive: all may be too many to keep
  double recall = 1;                            // found true contacts / all true contacts; 1 if there are none
  double precision = 1;                         // found true contacts / all found contacts; 1 if none is found
};

/// Searches a frame. Returns how long that took (ms): as long as the method says if it measures that itself.
inline double timed_search(collide::Detector& detector, const collide::Frame& frame, const collide::Settings& settings,
                           collide::Workers& workers, collide::Result& result) {
  const double ms = time_ms([&] { detector.detect(frame, settings, workers, result); });
  return result.own_ms.value_or(ms);
}

/// Does the same from scratch, as often as the clock needs. Returns the mean time (ms).
inline double timed_fresh_search(collide::Detector& detector, const collide::Frame& frame,
                                 const collide::Settings& settings, collide::Workers& workers,
                                 collide::Result& result) {
  const double ms = mean_ms([&] { detector.forget(); }, [&] { detector.detect(frame, settings, workers, result); });
  return result.own_ms.value_or(ms);
}

/// Returns part / whole; 1 if there is nothing.
inline double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Returns how far apart (m) the vertices of a contact are.
inline float distance(const collide::Contact& c, const collide::Frame& f) {
  return std::sqrt(collide::squared_distance(f.x[c.a], f.y[c.a], f.z[c.a], f.x[c.b], f.y[c.b], f.z[c.b]));
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
  const auto is_true = [&](const collide::Contact& contact) { return std::ranges::binary_search(truth, contact); };
  if (hits < found.size()) result.first_false = *std::ranges::find_if_not(found, is_true);
  return result;
}

}  // namespace app::compare
