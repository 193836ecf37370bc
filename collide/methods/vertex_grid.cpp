#include "collide/methods/vertex_grid.h"

#include <algorithm>

#include "collide/core/cutoff.h"

namespace collide::methods {

void VertexGrid::detect(const Frame& frame, std::span<const Index> which, const Settings& settings, Workers& workers,
                        Result& result) {
  settings_ = settings;
  const CellHash hash(settings);
  const double cutoff = contact_cutoff(settings.tolerance);
  hash_vertices(frame, which);
  constexpr double visit_ns = 60;  // of work, of a vertex
  const int parts = workers.threads_for(visit_ns * points_.size());
  search_.begin(frame, settings, points_, parts);
  threads_.resize(static_cast<std::size_t>(parts));
  workers.run(parts, [&](int part) {
    threads_[static_cast<std::size_t>(part)].hashes = 0;
    for (auto slot = static_cast<Index>(part); slot < points_.size(); slot += static_cast<Index>(parts)) {
      visit_cells(part, slot, cutoff, hash);
    }
  });
  table_.count(result.counters);
  result.counters.hashes += points_.size();
  for (const Thread& thread : threads_) result.counters.hashes += thread.hashes;
  search_.finish(result);
}

void VertexGrid::hash_vertices(const Frame& frame, std::span<const Index> which) {
  const CellHash hash(settings_);
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

void VertexGrid::visit_cells(int thread, Index slot, double cutoff, const CellHash& hash) {
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

DebugGeometry VertexGrid::debug() const {
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

}  // namespace collide::methods
