#pragma once
// Decides most queries of continuous collision detection in doubles, and in pairs of doubles, by signs that no rounding
// can change.

#include <cstdint>

#include "collide/oracle/feature_motion.h"

namespace collide::oracle {

struct Filtered {
  enum class Answer {
    apart,    // the features do not meet
    passing,  // they meet for the first time in the piece of time below, once; the side changes there, and only there
    unknown
  };
  Answer answer;
  std::uint64_t start = 0;  // the piece: from start / 2^halvings to (start + 1) / 2^halvings
  unsigned halvings = 0;
  bool inward = false;  // passing: the side changes from positive to negative
};

/// The piece is halved this often if doubles can tell where the root is.
inline constexpr unsigned most_halvings = 41;

/// Kind: VertexFace or EdgeEdge.
template <class Kind>
Filtered filter_motion(const Points& points);

}  // namespace collide::oracle
