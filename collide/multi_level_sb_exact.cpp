// Multi-Level SB Collide made exact: the boxes of §2.1, padded by half of the tolerance, are put into every cell that
// they overlap instead of the cells of their corners. Two vertices in contact then lie in padded boxes that overlap, so
// these share a cell, hence a bucket. Of two boxes only the vertices near the other box are tested. Where the grid is
// of no use (boxes of many cells, buckets of many boxes), pairs of boxes are found by sort and sweep.

#include "collide/box_sweep.h"
#include "collide/box_table.h"
#include "collide/cell_hash.h"
#include "collide/contact_search.h"
#include "collide/detectors.h"
#include "collide/reach.h"

namespace collide {

namespace {

constexpr double most_cells = 27;             // of a box in the grid: what one as wide as two cells can overlap
constexpr std::uint64_t most_meetings = 128;  // of a box in the table, on average: beyond it a sweep was faster

class MultiLevelSbExact final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    settings_ = settings;
    reach_ = contact_reach(settings.tolerance);
    bodies_.build(frame, result);
    const std::vector<BodyPair>& near_bodies = pairs_.find(bodies_, reach_);
    subdivision_.build(frame, bodies_, bodies_.live, settings.levels, workers);  // §2.1
    hash_boxes(result.counters);                                                 // §2.2
    search_.begin(frame, settings, subdivision_.points(), workers.threads());
    table_.prepare_pairs(workers.threads());
    sweep_.begin(bodies_, near_bodies, subdivision_.boxes(), settings.self_collision, reach_, workers.threads());
    workers.run([&](int thread) { test_boxes(thread, workers.threads()); });  // §2.3, §2.4
    search_.finish(result);
  }

  DebugGeometry debug() const override {
    DebugGeometry geometry;
    const CellHash hash(settings_);
    const float half = reach_ / 2;
    CellList cells;
    for (const Box& box : subdivision_.boxes()) {
      geometry.boxes.push_back({box.region.lo - half, box.region.hi + half, box.body});
      const CellRange range = cells_of(box.region, hash);
      if (range.count() <= most_cells) range.for_each([&](const CellHash::Cell& cell) { cells.add(cell, hash); });
    }
    geometry.cells = cells.take();
    table_.describe(geometry);
    return geometry;
  }

 private:
  /// The cells that the padded box overlaps. Exact in spite of rounding: for boxes within reach, lo - half of the one
  /// is not above hi + half of the other, and subtraction, division, floor and clamping all keep that order.
  CellRange cells_of(const Aabb& box, const CellHash& hash) const {
    const double half = double{reach_} / 2;
    return {hash.cell(box.lo.x - half, box.lo.y - half, box.lo.z - half),
            hash.cell(box.hi.x + half, box.hi.y + half, box.hi.z + half)};
  }

  void hash_boxes(Counters& counters) {
    const CellHash hash(settings_);
    const std::vector<Box>& boxes = subdivision_.boxes();
    swept_.assign(boxes.size(), false);
    any_swept_ = false;
    table_.clear();
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      buckets_.clear();
      const CellRange cells = cells_of(boxes[b].region, hash);
      if (cells.count() <= most_cells) {
        cells.for_each([&](const CellHash::Cell& cell) { buckets_.push_back(hash.bucket(cell)); });
      } else {
        swept_[b] = any_swept_ = true;
      }
      counters.hashes += buckets_.size();
      table_.add(buckets_);
    }
    table_.build(settings_.buckets);
    table_.buckets().count(counters);
    counters.boxes = boxes.size();
    sweep_all_ = table_.buckets().meetings() > most_meetings * boxes.size();
  }

  void test_boxes(int thread, int threads) {
    const std::vector<Box>& boxes = subdivision_.boxes();
    if (settings_.self_collision) {  // a box meets itself, too
      const Part part = part_of(boxes.size(), thread, threads);
      for (std::size_t a = part.begin; a < part.end; ++a) search_.test(thread, boxes[a].slots, boxes[a].slots);
    }
    const auto test = [&](Index a, Index b) {
      search_.test_near(thread, boxes[a].slots, boxes[b].slots, boxes[b].region);
    };
    if (sweep_all_) {
      sweep_.for_each_pair(thread, threads, test);
      return;
    }
    table_.for_each_pair(thread, threads, [&](Index a, Index b) {
      if (!settings_.self_collision && boxes[a].body == boxes[b].body) return;
      if (near(boxes[a].region, boxes[b].region, reach_)) test(a, b);
    });
    if (!any_swept_) return;
    sweep_.for_each_pair(thread, threads, [&](Index a, Index b) {
      if (swept_[a] || swept_[b]) test(a, b);  // the table has the others
    });
  }

  Settings settings_;
  float reach_ = 0;
  BodyBoxes bodies_;
  BodyPairs pairs_;
  Subdivision subdivision_;
  BoxTable table_;
  BoxSweep sweep_;
  std::vector<std::uint32_t> buckets_;  // of one box
  std::vector<bool> swept_;             // boxes that are not in the table
  bool any_swept_ = false, sweep_all_ = false;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb_exact() { return std::make_unique<MultiLevelSbExact>(); }

}  // namespace collide
