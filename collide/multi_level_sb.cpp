// Multi-Level SB Collide as the paper has it (§2): eight corner hashes a box. A box that exceeds a cell skips the cells
// between its corners, and boxes are not padded by the tolerance, so contacts can be missed.

#include "collide/box_table.h"
#include "collide/cell_hash.h"
#include "collide/contact_search.h"
#include "collide/detectors.h"
#include "collide/subdivision.h"

namespace collide {

namespace {

/// §2.2: the cells of the eight corner points, the minimum point's first.
std::array<CellHash::Cell, 8> corner_cells(const CellHash& hash, const Aabb& box) {
  std::array<CellHash::Cell, 8> cells;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    cells[corner] =
        hash.cell(corner & 4 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 1 ? box.hi.z : box.lo.z);
  }
  return cells;
}

bool exceeds_cell(const Aabb& box, const glm::vec3& cell) {
  for (int axis = 0; axis < 3; ++axis) {
    if (double{box.hi[axis]} - double{box.lo[axis]} > double{cell[axis]}) return true;
  }
  return false;
}

class MultiLevelSb final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    settings_ = settings;
    bodies_.build(frame, result);
    subdivision_.build(frame, bodies_, bodies_.live, settings.levels, workers);  // §2.1
    hash_corners(result);                                                        // §2.2
    search_.begin(frame, settings, subdivision_.points(), workers.threads());
    table_.prepare_meetings(workers.threads());
    workers.run([&](int thread) { test_boxes(thread, workers.threads()); });  // §2.3, §2.4
    search_.finish(result);
  }

  DebugGeometry debug() const override {
    DebugGeometry geometry;
    const CellHash hash(settings_);
    CellList cells;
    for (const Box& box : subdivision_.boxes()) {
      geometry.boxes.push_back({box.region.lo, box.region.hi, box.body});
      for (const auto& cell : corner_cells(hash, box.region)) cells.add(cell, hash);
    }
    geometry.cells = cells.take();
    table_.describe(geometry);
    return geometry;
  }

 private:
  void hash_corners(Result& result) {
    const CellHash hash(settings_);
    bool exceeded = false;
    table_.clear();
    end_of_body_.resize(bodies_.box.size());
    for (const Box& box : subdivision_.boxes()) {
      end_of_body_[box.body] = static_cast<Index>(table_.size() + 1);
      std::array<std::uint32_t, 8> buckets;
      const auto cells = corner_cells(hash, box.region);
      for (std::size_t corner = 0; corner < 8; ++corner) buckets[corner] = hash.bucket(cells[corner]);
      table_.add(buckets);
      exceeded = exceeded || exceeds_cell(box.region, settings_.cell_size);
    }
    table_.build(settings_.buckets);
    table_.buckets().count(result.counters);
    result.counters.boxes = table_.size();
    result.counters.hashes = 8 * table_.size();
    result.coverage = exceeded ? Coverage::exceeded : Coverage::covered;
  }

  void test_boxes(int thread, int threads) {
    const std::vector<Box>& boxes = subdivision_.boxes();
    const auto first = [&](Index a) { return settings_.self_collision ? a : end_of_body_[boxes[a].body]; };
    table_.for_each_run(thread, threads, first, [&](Index a, Range run) {
      search_.test(thread, boxes[a].slots, {boxes[run.begin].slots.begin, boxes[run.end - 1].slots.end});
    });
  }

  Settings settings_;
  BodyBoxes bodies_;
  Subdivision subdivision_;
  std::vector<Index> end_of_body_;  // of the bodies with boxes: past their last one
  BoxTable table_;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb() { return std::make_unique<MultiLevelSb>(); }

}  // namespace collide
