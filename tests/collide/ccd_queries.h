#pragma once
// Queries of continuous collision detection, and those of the public benchmark (Wang et al. 2021).

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "collide/oracle/moving_features.h"

namespace collide::test {

using Query = oracle::MovingFeatures;

struct KnownQuery : Query {
  bool meets;
};
/// Reads lines `kind,truth,x,y,z,...`: kind is vf or ee, truth is 0 or 1, then come the four points at time 0, and the
/// four points at time 1. Throws std::runtime_error if a line is none of these.
std::vector<KnownQuery> read_queries(const std::filesystem::path& file);

}  // namespace collide::test
