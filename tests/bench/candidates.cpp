#include "tests/bench/candidate.h"

#include <array>

#include "collide/exact/multi_level_sb_exact.h"
#include "collide/methods/detectors.h"

namespace bench {

std::span<const Candidate> candidates() {
  static const std::array table{
      Candidate{"exact", "multi-level-sb-exact, from scratch", true, collide::exact::make_multi_level_sb_exact},
      Candidate{"exact-reuse", "multi-level-sb-exact, frame after frame", false,
                collide::exact::make_multi_level_sb_exact},
      Candidate{"grid-hash", "grid-hash", true, collide::methods::make_grid_hash},
      Candidate{"sorted-grid", "sorted-grid", true, collide::methods::make_sorted_grid},
      Candidate{"sweep-and-prune", "sweep-and-prune, patches kept", false, collide::methods::make_sweep_and_prune},
      Candidate{"aabb-tree", "aabb-tree, refitted", false, collide::methods::make_aabb_tree},
      Candidate{"kd-tree", "kd-tree", true, collide::methods::make_kd_tree},
      Candidate{"octree", "octree", true, collide::methods::make_octree},
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
