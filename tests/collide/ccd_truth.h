#pragma once
// The truth about a query of continuous collision detection, in rational numbers, slow and written apart from the code
// under test: polynomials in t, roots by Sturm's theorem, features compared in projections along the axes.

#include "ccd_queries.h"

namespace collide::test {

struct Truth {
  std::optional<double> first_meeting;  // rounded
  std::optional<oracle::Passage> first_passage;
};
Truth truth_of(const Query& query);

}  // namespace collide::test
