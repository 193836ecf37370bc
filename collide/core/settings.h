#pragma once
// The settings of a detection.

#include <optional>
#include <string>

#include "collide/core/frame.h"

namespace collide {

inline constexpr int max_levels = 15;
inline constexpr std::uint32_t max_buckets = 1u << 24;
/// m. The squares of all tolerances between these are normal floats. Beyond them contacts would be lost.
inline constexpr float min_tolerance = 1e-18f, max_tolerance = 1e18f;
/// Teschner et al. 2003 with their composite 19349663 replaced by a prime.
inline constexpr std::array<std::uint32_t, 3> default_primes{73856093, 19349669, 83492791};

/// The settings of a detection. A method ignores those that it does not use.
struct Settings {
  float tolerance = 0.1f;                // m, min_tolerance .. max_tolerance: closer vertices are in contact (§2.3)
  bool self_collision = true;            // also pairs of one body (§2.4)
  int levels = 3;                        // 0 .. max_levels; a body's box is cut into 2^levels boxes (§2.1)
  std::uint32_t buckets = 1001;          // 1 .. max_buckets: the paper's "bucket size" (§2.2)
  std::optional<glm::vec3> cell_size{};  // m, finite and > 0: the paper's length, height, width. Methods with a hash
                                         // table need it; without it, who calls them takes automatic_cell_size().
  std::array<std::uint32_t, 3> primes = default_primes;  // > 0

  bool operator==(const Settings&) const = default;
};

/// Returns an empty string if the settings are valid, else one line that names the setting, its value and what is
/// allowed.
std::string problem(const Settings& settings);

/// Returns an empty string, or one line that names the primes that are 0 or equal modulo the bucket count. Such primes
/// make the hash ignore an axis or mix two axes.
std::string hash_warning(const Settings& settings);

/// Returns the automatic cell size (m, §2.2): on each axis the largest subdivided box of any body, plus the tolerance.
/// A body counts as it is at rest, or as it is in the frame if its shape does not know that. It does not guarantee full
/// recall. Never 0.
glm::vec3 automatic_cell_size(const Frame& frame, int levels, float tolerance);

}  // namespace collide
