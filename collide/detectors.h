#pragma once
// How to add a detector: write one file that is read beside the paper, built from the stages below; declare its make
// function here; add its row to the table in methods.cpp. Command line, panel, reports and tests then have it.
//
//   body_boxes.h      a box a body; leaves out and names the bodies that are not finite
//   body_pairs.h      bodies whose boxes come within the tolerance of each other
//   subdivision.h     2^levels midpoint boxes a body
//   cell_hash.h       grid cells, and the hash function of a cell
//   bucket_table.h    things sorted into buckets
//   box_table.h       boxes in buckets, and the pairs of boxes that share one
//   points.h          vertices in the order in which a method tests them
//   contact_search.h  tests runs of vertices, filters and orders the contacts
//   reach.h           how far apart two vertices in contact can be, rounding included

#include <memory>

#include "collide/detector.h"

namespace collide {

std::unique_ptr<Detector> make_brute_force();

}  // namespace collide
