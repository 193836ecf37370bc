#include "tests/bench/candidate.h"

#include <array>

#include "collide/exact/multi_level_sb_exact.h"
#include "collide/methods/detectors.h"

namespace bench {

std::span<const Candidate> candidates() {
  static constexpr std::array table{
      Candidate{"exact", "multi-level-sb-exact, from scratch", true, collide::exact::make_multi_level_sb_exact},
      Candidate{"exact-reuse", "multi-level-sb-exact, frame after frame", false,
                collide::exact::make_multi_level_sb_exact},
      Candidate{"grid-hash", "grid-hash", true, collide::methods::make_grid_hash},
      Candidate{"embree-rebuild", "Embree, built anew", true, make_embree_rebuild},
      Candidate{"embree-refit", "Embree, refitted", false, make_embree_refit},
      Candidate{"embree-patches", "Embree, refitted, patches of 8", false, make_embree_patches},
      Candidate{"nanoflann", "nanoflann, built anew", true, make_nanoflann},
      Candidate{"cgal", "CGAL box intersection, patches of 16", true, make_cgal},
      Candidate{"bullet", "Bullet btDbvt, refitted, patches of 16", false, make_bullet},
  };
  return table;
}

}  // namespace bench
