#pragma once
// The exact method of the table in collide/methods.cpp. Its stages, in the order of a frame:
//   core/vertex_kernels.h     the box and the bounding sphere of each body
//   body_broad_phase.h        pairs of bodies that are near each other; sweep_strips.h has its inner loop
//   resting_contacts.h        the contacts of bodies that have not moved since the last frame
//   self_collision_culling.h  proves for most bodies that they cannot touch themselves
//   pair_kernels.h            the vertices of two bodies that face each other, and the contacts among them
//   overlap_tree.h            subdivides the area where two bodies overlap, level by level
//   patch_search.h            does the work of these three inside large bodies and between them, on all threads;
//                             patch_kernels.h has its inner loops, and contact_rows.h sorts what it finds
//   body_pair_search.h        puts these together, body by body

#include <memory>

#include "collide/core/detector.h"

namespace collide::exact {

std::unique_ptr<Detector> make_multi_level_sb_exact();

}  // namespace collide::exact
