#pragma once
// Queries of continuous collision detection, and those of the public benchmark (Wang et al. 2021).

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "collide/oracle/moving_features.h"

namespace collide::test {

/// A vertex and the corners of a face, or the ends of two edges.
struct Query {
  enum class Kind { vertex_face, edge_edge };
  Kind kind;
  std::array<oracle::MovingPoint, 4> points;
};
std::optional<oracle::Meeting> meeting_of(const Query& query);
std::optional<oracle::Passage> passage_of(const Query& query);

struct KnownQuery : Query {
  bool meets;
};
/// Reads lines `kind,truth,x,y,z,...`: kind is vf or ee, truth is 0 or 1, then come the four points at time 0, and the
/// four points at time 1. Throws std::runtime_error if a line is none of these.
std::vector<KnownQuery> read_queries(const std::filesystem::path& file);

}  // namespace collide::test
