// Multi-Level SB Collide as the paper has it (§2): eight corner hashes a box. A box that exceeds a cell skips the cells
// between its corners, and boxes are not padded by the tolerance, so contacts can be missed. And the same method made
// complete: only its §2.2 differs, which says into which buckets a box goes.

#include <glm/vector_relational.hpp>

#include "collide/core/contact_search.h"
#include "collide/core/cutoff.h"
#include "collide/methods/box_table.h"
#include "collide/methods/cell_hash.h"
#include "collide/methods/detectors.h"
#include "collide/methods/subdivision.h"

namespace collide::methods {

namespace {

/// Something of a box's minimum and of its maximum on each axis. The eight corners are their combinations.
template <class T>
using Sides = std::array<std::array<T, 2>, 3>;

/// Calls visit(x, y, z) for each corner, the minimum point first.
template <class T, class Visit>
void for_each_corner(const Sides<T>& sides, const Visit& visit) {
  for (const T x : sides[0]) {
    for (const T y : sides[1]) {
      for (const T z : sides[2]) visit(x, y, z);
    }
  }
}

/// Returns the indices of the cells that its corners lie in.
Sides<std::int64_t> indices_of(const Aabb& box, const CellHash& hash) {
  Sides<std::int64_t> indices;
  for (int axis = 0; axis < 3; ++axis) {
    indices[static_cast<std::size_t>(axis)] = {hash.index(axis, box.lo[axis]), hash.index(axis, box.hi[axis])};
  }
  return indices;
}

bool exceeds_cell(const Aabb& box, const glm::vec3& cell) {
  return glm::any(glm::greaterThan(glm::dvec3(box.hi) - glm::dvec3(box.lo), glm::dvec3(cell)));
}

/// §2.2 to the letter: a box goes into the buckets of its eight corners. Corners lie on the borders of the body's cuts
/// and share them.
class CornerHash {
 public:
  CornerHash(const Settings& settings, Index) : settings_(settings), hash_(settings) {}

  void begin_body(const Aabb& body) {
    const std::array<Cuts, 3> cuts = cuts_of(body, settings_.levels);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      for (std::size_t border = 0; border <= static_cast<std::size_t>(cuts[axis].intervals()); ++border) {
        residue_[axis][border] = hash_.residue(a, hash_.index(a, cuts[axis].border[border]));
      }
    }
  }

  std::span<const std::uint32_t> buckets(const SubdividedBox& box) {
    Sides<std::uint32_t> sides;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t low = box.interval[axis];
      sides[axis] = {residue_[axis][low], residue_[axis][low + 1]};
    }
    std::size_t corner = 0;
    for_each_corner(sides, [&](auto x, auto y, auto z) { buckets_[corner++] = hash_.bucket_of_residues(x, y, z); });
    exceeded_ = exceeded_ || exceeds_cell(box.region, *settings_.cell_size);
    return buckets_;
  }

  Coverage coverage() const { return exceeded_ ? Coverage::exceeded : Coverage::covered; }

  /// Adds the cells that a box is hashed into.
  void list_cells(const SubdividedBox& box, CellList& cells) const {
    for_each_corner(indices_of(box.region, hash_), [&](auto x, auto y, auto z) { cells.add({x, y, z}, hash_); });
  }

 private:
  Settings settings_;
  CellHash hash_;
  std::array<std::array<std::uint32_t, (1 << Cuts::max_depth) + 1>, 3> residue_;
  std::array<std::uint32_t, 8> buckets_;
  bool exceeded_ = false;
};

/// §2.2 made complete: a box, padded by half the cutoff, goes into the bucket of every cell that it overlaps.
///
/// Then two boxes with vertices p, q in contact share a cell. With h half the cutoff, p - q <= 2h along each axis, so
/// p - h <= q + h. The region of a box holds its vertices, and rounding and the index of a cell are monotonic, so the
/// first cell of p's box is not behind the last one of q's, and the other way round.
class OverlapHash {
 public:
  OverlapHash(const Settings& settings, Index vertices)
      : hash_(settings), half_(contact_cutoff(settings.tolerance) / 2.0), vertices_(vertices) {}

  void begin_body(const Aabb&) {}

  /// Returns no bucket for a box that overlaps too many cells to list them. Call it, or list_cells(), once for each
  /// box.
  std::span<const std::uint32_t> buckets(const SubdividedBox& box) {
    buckets_.clear();
    for_each_listed_cell(box, [&](const CellHash::Cell& cell) { buckets_.push_back(hash_.bucket(cell)); });
    return buckets_;
  }

  Coverage coverage() const { return Coverage::exact; }

  void list_cells(const SubdividedBox& box, CellList& list) {
    for_each_listed_cell(box, [&](const CellHash::Cell& cell) { list.add(cell, hash_); });
  }

 private:
  template <class Visit>
  void for_each_listed_cell(const SubdividedBox& box, const Visit& visit) {
    const CellRange cells = cells_of(box);
    if (cells.count() > max_listed_cells(vertices_, room_)) return;
    room_ -= cells.count();
    cells.for_each(visit);
  }

  CellRange cells_of(const SubdividedBox& box) const {
    const auto cell_at = [&](const glm::vec3& corner, double by) {
      return hash_.cell(corner.x + by, corner.y + by, corner.z + by);
    };
    return {cell_at(box.region.lo, -half_), cell_at(box.region.hi, half_)};
  }

  CellHash hash_;
  double half_, vertices_;
  double room_ = room_for_cells;  // for the boxes to come
  std::vector<std::uint32_t> buckets_;
};

/// Hashing: CornerHash or OverlapHash.
template <class Hashing>
class MultiLevelSb final : public Detector {
 public:
  /// All of a frame but its contacts.
  void build(const Frame& frame, const Settings& settings, Workers& workers, Result& result) {
    settings_ = settings;
    bodies_.build(frame, result);
    subdivision_.build(frame, bodies_, bodies_.live, settings.levels, workers);  // §2.1
    hash_boxes(result);                                                          // §2.2
  }

  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    build(frame, settings, workers, result);
    constexpr double test_ns = 20;  // of work, of a vertex
    const int parts = workers.threads_for(test_ns * subdivision_.points().size());
    search_.begin(frame, settings, subdivision_.points(), parts);
    table_.prepare_meetings(parts);
    workers.run(parts, [&](int part) { test_boxes(part, parts); });  // §2.3, §2.4
    search_.finish(result);
  }

  DebugGeometry debug() const override {
    DebugGeometry geometry;
    if (!settings_.cell_size) return geometry;  // before the first frame
    Hashing hashing(settings_, subdivision_.points().size());
    CellList cells;
    for (const SubdividedBox& box : subdivision_.boxes()) {
      geometry.boxes.push_back({box.region.lo, box.region.hi, box.body});
      hashing.list_cells(box, cells);
    }
    geometry.cells = cells.take();
    table_.describe(geometry);
    return geometry;
  }

 private:
  void hash_boxes(Result& result) {
    const std::vector<SubdividedBox>& boxes = subdivision_.boxes();
    Hashing hashing(settings_, subdivision_.points().size());
    table_.clear();
    end_of_body_.resize(bodies_.box.size());
    for (std::size_t next = 0; next < boxes.size();) {
      const Index body = boxes[next].body;
      hashing.begin_body(bodies_.box[body]);
      for (; next < boxes.size() && boxes[next].body == body; ++next) {
        const std::span<const std::uint32_t> buckets = hashing.buckets(boxes[next]);
        table_.add(buckets);
        result.counters.hashes += buckets.size();
      }
      end_of_body_[body] = static_cast<Index>(next);
    }
    table_.build(settings_.buckets);
    result.counters.boxes = table_.size();
    result.coverage = hashing.coverage();
  }

  /// Tests each box against all that it meets: of the short runs of vertices many at a time.
  void test_boxes(int thread, int threads) {
    constexpr Index short_run = 64, max_runs = 256;  // 2^20 pairs
    const std::vector<SubdividedBox>& boxes = subdivision_.boxes();
    const bool self = settings_.self_collision;
    std::vector<Range> runs;
    for (auto a = static_cast<Index>(thread); a < boxes.size(); a += static_cast<Index>(threads)) {
      const Range own = boxes[a].slots;
      if (self) search_.test(thread, own, own);  // a box meets itself, too
      table_.for_each_run(thread, a, self ? a + 1 : end_of_body_[boxes[a].body], [&](Range met) {
        const Range run{boxes[met.begin].slots.begin, boxes[met.end - 1].slots.end};
        if (own.size() > short_run || run.size() > short_run) return search_.test(thread, own, run);
        runs.push_back(run);
        if (runs.size() < max_runs) return;
        search_.test(thread, own, runs);
        runs.clear();
      });
      search_.test(thread, own, runs);
      runs.clear();
    }
  }

  Settings settings_;
  BodyBoxes bodies_;
  Subdivision subdivision_;
  std::vector<Index> end_of_body_;  // of the bodies with boxes: past their last one
  BoxTable table_;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb() { return std::make_unique<MultiLevelSb<CornerHash>>(); }
std::unique_ptr<Detector> make_multi_level_sb_complete() { return std::make_unique<MultiLevelSb<OverlapHash>>(); }

PaperStructure make_paper_structure() {
  return [method = std::make_shared<MultiLevelSb<CornerHash>>()](const Frame& frame, const Settings& settings,
                                                                 Workers& workers) {
    Result unused;
    method->build(frame, settings, workers, unused);
    return method->debug();
  };
}

}  // namespace collide::methods
