// The rivals "Grid Hash" and "Bounding Box + Grid Hash": vertices are hashed one by one into a grid (§2.2 without
// boxes). The former hashes every vertex of every body and builds no box. The latter hashes only those of bodies whose
// box overlaps another body's; with self-collision that is every body, since each overlaps itself.
// Memory: 36 bytes a vertex and 4 bytes a bucket. However small the cells are, a thread lists at most 64 cells at a
// time, or a 32nd of the number of vertices.

#include <algorithm>

#include "collide/core/body_boxes.h"
#include "collide/core/contact_search.h"
#include "collide/core/cutoff.h"
#include "collide/methods/bucket_table.h"
#include "collide/methods/cell_hash.h"
#include "collide/methods/detectors.h"

namespace collide::methods {

namespace {

class GridHash final : public Detector {
 public:
  explicit GridHash(bool boxes_first) : boxes_first_(boxes_first) {}

  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    settings_ = settings;
    const CellHash hash(settings);
    const float cutoff = contact_cutoff(settings.tolerance);
    bodies_.build(frame, result);
    if (boxes_first_) {
      result.counters.boxes = bodies_.live.size();
      find_touching(cutoff);
    }
    hash_vertices(frame, boxes_first_ && !settings.self_collision ? touching_ : bodies_.live, hash);
    constexpr double visit_ns = 60;  // of work, of a vertex
    const int parts = workers.threads_for(visit_ns * points_.size());
    search_.begin(frame, settings, points_, parts);
    threads_.resize(static_cast<std::size_t>(parts));
    workers.run(parts, [&](int part) {
      threads_[static_cast<std::size_t>(part)].hashes = 0;
      for (auto slot = static_cast<Index>(part); slot < points_.size(); slot += static_cast<Index>(parts)) {
        visit_cells(part, slot, double{cutoff}, hash);
      }
    });
    result.counters.hashes += points_.size();
    for (const Thread& thread : threads_) result.counters.hashes += thread.hashes;
    search_.finish(result);
  }

  DebugGeometry debug() const override {
    DebugGeometry geometry;
    if (!settings_.cell_size) return geometry;  // before the first frame
    const CellHash hash(settings_);
    CellList cells;
    for (Index slot = 0; slot < points_.size(); ++slot) {
      cells.add(hash.cell(points_.x[slot], points_.y[slot], points_.z[slot]), hash);
    }
    geometry.vertices = vertex_;
    geometry.cells = cells.take();
    geometry.buckets = table_.buckets();
    geometry.loads = table_.loads();
    return geometry;
  }

 private:
  struct alignas(64) Thread {
    std::vector<std::uint32_t> buckets;
    std::uint64_t hashes;
  };

  void find_touching(float cutoff) {
    touching_.clear();
    for (const BodyPair& pair : pairs_.find(bodies_, cutoff)) touching_.insert(touching_.end(), {pair.a, pair.b});
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
  }

  void hash_vertices(const Frame& frame, std::span<const Index> which, const CellHash& hash) {
    vertex_.clear();
    body_.clear();
    bucket_.clear();
    for (const Index body : which) {
      for (Index v = frame.bodies->first[body]; v < frame.bodies->first[body + 1]; ++v) {
        vertex_.push_back(v);
        body_.push_back(body);
        bucket_.push_back(hash.bucket(hash.cell(frame.x[v], frame.y[v], frame.z[v])));
      }
    }
    table_.build(bucket_, settings_.buckets);
    points_.resize(static_cast<Index>(vertex_.size()));
    for (std::size_t e = 0; e < vertex_.size(); ++e) points_.set(table_.slot(e), frame, vertex_[e], body_[e]);
  }

  /// Tests the vertex against those in all cells within the cutoff, at any cell size.
  void visit_cells(int thread, Index slot, double cutoff, const CellHash& hash) {
    const double x = points_.x[slot], y = points_.y[slot], z = points_.z[slot];
    const CellRange near{hash.cell(x - cutoff, y - cutoff, z - cutoff), hash.cell(x + cutoff, y + cutoff, z + cutoff)};
    if (near.count() > max_listed_cells(points_.size())) {  // test all vertices that are left
      search_.test(thread, {slot, slot + 1}, {slot + 1, points_.size()});
      return;
    }
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    own.buckets.clear();
    near.for_each([&](const CellHash::Cell& cell) { own.buckets.push_back(hash.bucket(cell)); });
    own.hashes += own.buckets.size();
    std::sort(own.buckets.begin(), own.buckets.end());  // two cells may share a bucket, which is visited once
    own.buckets.erase(std::unique(own.buckets.begin(), own.buckets.end()), own.buckets.end());
    for (const std::uint32_t bucket : own.buckets) {
      const Range others = table_.slots(bucket);
      if (others.end > slot + 1) search_.test(thread, {slot, slot + 1}, {std::max(others.begin, slot + 1), others.end});
    }
  }

  bool boxes_first_;
  Settings settings_;
  BodyBoxes bodies_;
  BodyPairs pairs_;
  std::vector<Index> touching_;        // bodies that are near another
  std::vector<Index> vertex_, body_;   // in the order in which they are hashed
  std::vector<std::uint32_t> bucket_;  // of each of them
  BucketTable table_;
  Points points_;  // bucket by bucket
  std::vector<Thread> threads_;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_grid_hash() { return std::make_unique<GridHash>(false); }
std::unique_ptr<Detector> make_bounding_box_grid_hash() { return std::make_unique<GridHash>(true); }

}  // namespace collide::methods
