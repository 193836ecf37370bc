#pragma once

#include <vector>

#include "collide/core/detector.h"

namespace tests {

/// Returns the number of entries of every bucket of the table, with the empty buckets.
inline std::vector<std::uint32_t> bucket_loads(const collide::DebugGeometry& debug) {
  std::vector<std::uint32_t> loads(debug.buckets, 0);
  for (const auto& [bucket, load] : debug.loads) loads[bucket] += load;
  return loads;
}

}  // namespace tests
