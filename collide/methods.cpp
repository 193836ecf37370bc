#include "collide/methods.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "collide/exact/multi_level_sb_exact.h"
#include "collide/methods/detectors.h"

namespace collide {

namespace {

std::vector<Method> built_in() {
  return {
      {.key = "brute-force",
       .name = "Brute force",
       .summary = "Tests every vertex against every other: the exact reference.",
       .description =
           "Tests every vertex against every other. Choose it as the reference, or for a few hundred vertices. Cost: "
           "n²/2 tests. It builds nothing and keeps nothing.",
       .group = MethodGroup::rivals,
       .tests = PairTests::all,
       .make = methods::make_brute_force},
      {.key = "grid-hash",
       .name = "Grid Hash",
       .summary = "Hashes every vertex into a grid, without boxes (§3).",
       .description =
           "Puts every vertex into a cell of a grid and hashes the cell (§2.2). Then it looks into all cells within "
           "the tolerance, at any cell size, so it misses nothing. Choose it to see what the paper compares itself "
           "with; where only contacts count, Sorted grid is the faster form. Cost: n hashes and those of the cells "
           "around each vertex; linear in n if there are more buckets than vertices, else n². It rebuilds its table "
           "in every frame. Source: the paper's §3; Teschner et al. 2003.",
       .group = MethodGroup::rivals,
       .uses_hash = true,
       .make = methods::make_grid_hash},
      {.key = "bounding-box",
       .name = "Bounding Box",
       .summary = "Tests all vertices of bodies whose boxes overlap (§3).",
       .description =
           "Tests all vertices of two bodies whose boxes come within the tolerance, and all pairs inside each body. "
           "Choose it for small bodies that seldom meet. Cost: linear in the number of bodies that stay apart, but "
           "quadratic in the vertices of a body. It rebuilds the boxes in every frame. Source: the paper's §3.",
       .group = MethodGroup::rivals,
       .tests = PairTests::of_near_bodies,
       .make = methods::make_bounding_box},
      {.key = "bounding-box-grid-hash",
       .name = "Bounding Box + Grid Hash",
       .summary = "Hashes only the vertices of bodies whose boxes overlap (§3).",
       .description =
           "Hashes only the vertices of bodies whose boxes come within the tolerance. With self-collision, these are "
           "all bodies. Choose it over Grid Hash where most bodies are alone and none can touch itself. Cost: as "
           "Grid Hash, for these vertices. It rebuilds boxes and table in every frame. Source: the paper's §3.",
       .group = MethodGroup::rivals,
       .uses_hash = true,
       .make = methods::make_bounding_box_grid_hash},
      {.key = "multi-level-sb",
       .name = "Multi-Level SB",
       .summary = "The paper's method: hashes the eight corners of each subdivided box (§2). It can miss contacts.",
       .description =
           "The paper's method, to the letter; these pages also call it the literal method. It cuts the box of each "
           "body into 2^levels boxes, hashes the eight corners of each, and tests the vertices of boxes that share a "
           "bucket. Choose it to see what the paper describes: it misses contacts where a box is larger than a cell, "
           "and some across the faces of cells. Cost: eight hashes for each of at most n boxes, and the tests of "
           "boxes that share a bucket, be it by chance; linear in n with enough buckets, else n². It rebuilds "
           "everything in every frame. Source: the paper's §2.",
       .group = MethodGroup::paper,
       .exact = false,
       .uses_levels = true,
       .uses_hash = true,
       .make = methods::make_multi_level_sb},
      {.key = "multi-level-sb-complete",
       .name = "Multi-Level SB, complete",
       .summary = "The paper's method with padded boxes in all cells that they overlap (§2). It misses nothing.",
       .description =
           "The paper's method with one change, so that it misses nothing: a box is padded by half the tolerance and "
           "goes into every cell that it overlaps, not only into those of its corners. Choose it to see what "
           "completeness costs where nothing else is changed. Cost: a hash for each of these cells, at most eight a "
           "box at the default cell size, and many more where cells are small; else as the paper's method. It "
           "rebuilds everything in every frame. Source: the paper's §2; the change is ours.",
       .group = MethodGroup::paper,
       .uses_levels = true,
       .uses_hash = true,
       .make = methods::make_multi_level_sb_complete},
      {.key = "multi-level-sb-exact",
       .name = "Multi-Level SB, exact",
       .summary = "Searches only where bodies face each other, without a hash (§2.1, §5). It misses nothing.",
       .description =
           "Keeps the paper's idea (boxes of bodies, boxes of their parts, tests where boxes meet) and drops the hash. "
           "Of two near bodies it looks only at the vertices that face the other body or, if these are many, at the "
           "patches of 16 vertices that come near it; it proves of most bodies that they cannot touch themselves. "
           "Choose it wherever contacts are what you need: it is the fastest here and misses nothing. Cost: linear in "
           "n and in the pairs of near bodies. It searches from scratch in every frame, but bodies at rest keep their "
           "contacts, and shapes their patches. Source: the paper's §2.1 and §5; the rest is ours.",
       .group = MethodGroup::paper,
       .make = exact::make_multi_level_sb_exact},
      {.key = "sorted-grid",
       .name = "Sorted grid",
       .summary = "Sorts all vertices into cells of the tolerance's size, by counting.",
       .description =
           "Sorts all vertices into the cells of a uniform grid by counting, and tests each against those of its own "
           "and of the 26 adjacent cells. Cells are as large as the tolerance. Choose it for particles, or for "
           "meshes whose bodies mean little, at a tolerance below the distance of neighbours. Cost: linear in n, and "
           "in the pairs that are about as close as the tolerance. It rebuilds the grid in every frame. Source: "
           "Green 2008, \"CUDA Particles\"; the grid is rolled up so that its size follows n alone.",
       .group = MethodGroup::sorted,
       .make = methods::make_sorted_grid},
      {.key = "sweep-and-prune",
       .name = "Sweep and prune",
       .summary = "Sorts boxes of bodies, then of patches of 16 vertices, along one axis.",
       .description =
           "Sorts the boxes of the bodies along the axis on which they are spread widest and keeps the pairs that "
           "overlap on all three; inside these pairs, and inside each body, it does the same with boxes around "
           "patches of up to 16 neighbouring vertices. Choose it for few bodies, or for bodies in a long row; it is "
           "simple, and most physics engines have it. Cost: sorting, and all pairs of boxes that overlap along that "
           "one axis, so more than linear in the number of bodies of a heap. It cuts the patches once, refits their "
           "boxes and rebuilds the order in every frame. Source: Baraff 1992; Cohen et al. 1995.",
       .group = MethodGroup::sorted,
       .make = methods::make_sweep_and_prune},
      {.key = "aabb-tree",
       .name = "AABB tree",
       .summary = "Goes down a tree of boxes for each body, refitted, and one over the bodies.",
       .description =
           "Keeps a tree of boxes for each body, whose leaves are patches of up to 16 neighbouring vertices, and a "
           "tree over the bodies; goes down all of them with pairs of boxes that come within the tolerance. Choose "
           "it for meshes that bend but stay whole: it is the usual way of physics engines, and it has no setting. "
           "Cost: linear in n to refit, n log n over the bodies, and about log n for each pair of near patches. It "
           "cuts the bodies once, refits their trees and rebuilds the one over the bodies in every frame. Source: "
           "van den Bergen 1997.",
       .group = MethodGroup::trees,
       .make = methods::make_aabb_tree},
      {.key = "kd-tree",
       .name = "k-d tree",
       .summary = "Halves all vertices again and again at medians, and compares the tree with itself.",
       .description =
           "Halves all vertices near the median across the longest side, again and again, whatever body they belong "
           "to, and goes down the tree with pairs of boxes that come within the tolerance. Choose it for scattered "
           "points of very uneven density. Cost: n log n to build, and about log n for each pair of near leaves. It "
           "rebuilds the tree in every frame. Source: Bentley 1975.",
       .group = MethodGroup::trees,
       .make = methods::make_kd_tree},
      {.key = "octree",
       .name = "Octree",
       .summary = "Cuts the box of all vertices into eight again and again, and compares the tree with itself.",
       .description =
           "Cuts the box of all vertices into up to eight parts at the middle of its sides, again and again, and "
           "goes down the tree with pairs of boxes that come within the tolerance. Choose it where a k-d tree would "
           "serve and building counts: it has fewer levels, but leaves of uneven size. Cost: n log n to build for "
           "points of even density, and about log n for each pair of near leaves. It rebuilds the tree in every "
           "frame. Source: Meagher 1980.",
       .group = MethodGroup::trees,
       .make = methods::make_octree},
  };
}

/// Rows never move, and readers count only those that are complete.
class Table {
 public:
  Table() : rows_(built_in()), count_(rows_.size()) { rows_.reserve(max_methods); }
  std::span<const Method> rows() const { return {rows_.data(), count_.load()}; }
  void add(Method row) {
    const std::scoped_lock lock(adding_);
    assert(row.make && std::ranges::find(rows_, row.key, &Method::key) == rows_.end());
    if (rows_.size() == max_methods) throw std::length_error("more than " + std::to_string(max_methods) + " methods");
    rows_.push_back(std::move(row));
    count_ = rows_.size();
  }

 private:
  std::vector<Method> rows_;
  std::atomic<std::size_t> count_;
  std::mutex adding_;
};

Table& table() {
  static Table table;
  return table;
}

}  // namespace

std::span<const Method> method_table() { return table().rows(); }

void add_method(Method row) { table().add(std::move(row)); }

const Method* find_method(std::string_view key) {
  const std::span<const Method> rows = method_table();  // which may grow meanwhile
  const auto found = std::ranges::find(rows, key, &Method::key);
  return found == rows.end() ? nullptr : &*found;
}

const Method* find_driver(std::string_view key) {
  const Method* method = find_method(key);
  return method && method->can_drive() ? method : nullptr;
}

std::string method_keys() {
  std::string keys;
  for (const Method& method : method_table())
    if (method.can_drive()) keys.append(keys.empty() ? "" : ", ").append(method.key);
  return keys;
}

}  // namespace collide
