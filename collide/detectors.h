#pragma once
// How to add a detector: write one file that is read beside the paper, built from the stages below; declare its make
// function here; add its row to the table in methods.cpp. Command line, panel, reports and tests then have it.
//
//   body_boxes.h      a box a body, and pairs of bodies whose boxes are near; names the bodies that are not finite
//   subdivision.h     2^levels midpoint boxes a body
//   cell_hash.h       grid cells, and the hash function of a cell
//   bucket_table.h    things sorted into buckets
//   box_table.h       boxes in buckets, and the pairs of boxes that share one
//   vertex_grid.h     vertices in buckets, and all contacts among them
//   points.h          vertices in the order in which a method tests them
//   contact_search.h  tests runs of vertices, filters and orders the contacts
//   reach.h           how far apart two vertices in contact can be, rounding included
//   near_bodies.h     bodies near each other, by strips and spheres: for many bodies, on all threads
//   strip_boxes.h     boxes in strips, and the sweep along one
//   vertex_kernels.h  the loops over the vertices of one body, in the processor's widest instructions
//   pair_kernels.h    the loops over pairs of vertices, in the same
//   self_proof.h      proves for a frame that a body cannot touch itself
//   resting_contacts.h  the contacts of bodies that have not moved since the last frame
//   overlap_tree.h    the area where two bodies overlap, cut level by level
//   group_search.h    all contacts from these, body by body

#include <functional>
#include <memory>

#include "collide/detector.h"

namespace collide {

std::unique_ptr<Detector> make_brute_force();
std::unique_ptr<Detector> make_grid_hash();
std::unique_ptr<Detector> make_bounding_box();
std::unique_ptr<Detector> make_bounding_box_grid_hash();
std::unique_ptr<Detector> make_multi_level_sb();
std::unique_ptr<Detector> make_multi_level_sb_exact();

/// What debug() of the paper's method shows on a frame, without the search for contacts, which may take far longer.
/// Copies share the memory that it keeps from frame to frame: not for two threads at once.
using PaperStructure = std::function<DebugGeometry(const Frame&, const Settings&, Workers&)>;
PaperStructure make_paper_structure();

}  // namespace collide
