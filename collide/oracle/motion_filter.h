#pragma once
// Decides most queries of continuous collision detection in plain doubles, by signs that no rounding can change.

#include "collide/oracle/feature_motion.h"

namespace collide::oracle {

struct Filtered {
  enum class Answer {
    apart,    // the features do not meet
    passing,  // they meet for the first time in the piece of time below, once; the side changes there, and only there
    unknown
  };
  Answer answer;
  unsigned start = 0, halvings = 0;  // from start / 2^halvings to (start + 1) / 2^halvings
};

/// Kind: VertexFace or EdgeEdge.
template <class Kind>
Filtered filter_motion(const Points& points);

}  // namespace collide::oracle
