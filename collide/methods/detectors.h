#pragma once
// The paper's method and its rivals, a file each, written to be read beside the paper. To add one: write its file from
// the stages below, declare its make function here, and add its row to the table in collide/methods.cpp. The command
// line, the panel, the reports and the tests loop over that table.
//
// Stages in core/:
//   body_boxes.h      the bounding box of each body and the pairs of bodies whose boxes are near
//   points.h          vertices in the order in which a method tests them
//   contact_search.h  tests runs of vertices against each other; filters and sorts the contacts
//   counting_sort.h   sorts items by small numbers, on all threads
//   cutoff.h          the largest distance of two vertices in contact, rounding included
// Stages in trees/:
//   body_trees.h      a tree of boxes over the patches of each body, refitted
//   point_tree.h      a tree over all vertices, built anew
//   tree_search.h     finds the contacts among the vertices of a tree
// Stages here:
//   subdivision.h     the 2^levels subdivided boxes of each body
//   cell_hash.h       grid cells and the hash function of a cell
//   bucket_table.h    items sorted into buckets
//   box_table.h       boxes in buckets and the pairs of boxes that share one

#include <functional>
#include <memory>

#include "collide/core/detector.h"

namespace collide::methods {

std::unique_ptr<Detector> make_brute_force();
std::unique_ptr<Detector> make_grid_hash();
std::unique_ptr<Detector> make_bounding_box();
std::unique_ptr<Detector> make_bounding_box_grid_hash();
std::unique_ptr<Detector> make_multi_level_sb();
std::unique_ptr<Detector> make_multi_level_sb_complete();
std::unique_ptr<Detector> make_sorted_grid();
std::unique_ptr<Detector> make_sweep_and_prune();
std::unique_ptr<Detector> make_aabb_tree();
std::unique_ptr<Detector> make_kd_tree();
std::unique_ptr<Detector> make_octree();

/// What debug() of the paper's method shows on a frame, without the search for contacts, which may take far longer.
/// Copies share the memory that it keeps from frame to frame: not for two threads at once.
using PaperStructure = std::function<DebugGeometry(const Frame&, const Settings&, Workers&)>;
PaperStructure make_paper_structure();

}  // namespace collide::methods
