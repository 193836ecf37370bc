// Multi-Level SB Collide as the paper has it (§2): eight corner hashes a box. A box that exceeds a cell skips the cells
// between its corners, and boxes are not padded by the tolerance, so contacts can be missed.

#include "collide/methods/box_table.h"
#include "collide/methods/cell_hash.h"
#include "collide/methods/detectors.h"
#include "collide/methods/scattered_search.h"
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

/// The cells' indices of its corners.
Sides<std::int64_t> indices_of(const Aabb& box, const CellHash& hash) {
  Sides<std::int64_t> indices;
  for (int axis = 0; axis < 3; ++axis) {
    indices[static_cast<std::size_t>(axis)] = {hash.index(axis, box.lo[axis]), hash.index(axis, box.hi[axis])};
  }
  return indices;
}

/// §2.2: the buckets of the corner points of a body's boxes. Corners lie on the borders of its cuts and share them.
class CornerHash {
 public:
  CornerHash(const Aabb& body, int levels, const CellHash& hash) : hash_(hash) {
    const std::array<Cuts, 3> cuts = cuts_of(body, levels);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      for (std::size_t border = 0; border <= static_cast<std::size_t>(cuts[axis].intervals()); ++border) {
        residue_[axis][border] = hash.residue(a, hash.index(a, cuts[axis].border[border]));
      }
    }
  }

  std::array<std::uint32_t, 8> buckets(const SubdividedBox& box) const {
    Sides<std::uint32_t> sides;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t low = box.interval[axis];
      sides[axis] = {residue_[axis][low], residue_[axis][low + 1]};
    }
    std::array<std::uint32_t, 8> buckets;
    std::size_t corner = 0;
    for_each_corner(sides, [&](auto x, auto y, auto z) { buckets[corner++] = hash_.bucket_of_residues(x, y, z); });
    return buckets;
  }

 private:
  const CellHash& hash_;
  std::array<std::array<std::uint32_t, (1 << Cuts::max_depth) + 1>, 3> residue_;
};

bool exceeds_cell(const Aabb& box, const glm::vec3& cell) {
  for (int axis = 0; axis < 3; ++axis) {
    if (double{box.hi[axis]} - double{box.lo[axis]} > double{cell[axis]}) return true;
  }
  return false;
}

class MultiLevelSb final : public Detector {
 public:
  /// All of a frame but its contacts.
  void build(const Frame& frame, const Settings& settings, Workers& workers, Result& result) {
    settings_ = settings;
    bodies_.build(frame, result);
    subdivision_.build(frame, bodies_, bodies_.live, settings.levels, workers);  // §2.1
    hash_corners(result);                                                        // §2.2
  }

  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    build(frame, settings, workers, result);
    search_.begin(frame, settings, subdivision_.points(), workers.threads());
    scattered_.begin(search_, workers.threads());
    table_.prepare_meetings(workers.threads());
    workers.run([&](int thread) { test_boxes(thread, workers.threads()); });  // §2.3, §2.4
    search_.finish(result);
  }

  DebugGeometry debug() const override {
    DebugGeometry geometry;
    const CellHash hash(settings_);
    CellList cells;
    for (const SubdividedBox& box : subdivision_.boxes()) {
      geometry.boxes.push_back({box.region.lo, box.region.hi, box.body});
      for_each_corner(indices_of(box.region, hash), [&](auto x, auto y, auto z) { cells.add({x, y, z}, hash); });
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
    const std::vector<SubdividedBox>& boxes = subdivision_.boxes();
    for (std::size_t next = 0; next < boxes.size();) {
      const Index body = boxes[next].body;
      const CornerHash corners(bodies_.box[body], settings_.levels, hash);
      for (; next < boxes.size() && boxes[next].body == body; ++next) {
        table_.add(corners.buckets(boxes[next]));
        exceeded = exceeded || exceeds_cell(boxes[next].region, settings_.cell_size);
      }
      end_of_body_[body] = static_cast<Index>(next);
    }
    table_.build(settings_.buckets);
    table_.buckets().count(result.counters);
    result.counters.boxes = table_.size();
    result.counters.hashes = 8 * table_.size();
    result.coverage = exceeded ? Coverage::exceeded : Coverage::covered;
  }

  void test_boxes(int thread, int threads) {
    const std::vector<SubdividedBox>& boxes = subdivision_.boxes();
    const bool self = settings_.self_collision;
    for (auto a = static_cast<Index>(thread); a < boxes.size(); a += static_cast<Index>(threads)) {
      scattered_.start(thread, boxes[a].slots, self);  // a box meets itself, too
      table_.for_each_run(thread, a, self ? a + 1 : end_of_body_[boxes[a].body], [&](Range run) {
        scattered_.add(thread, {boxes[run.begin].slots.begin, boxes[run.end - 1].slots.end});
      });
      scattered_.finish(thread);
    }
  }

  Settings settings_;
  BodyBoxes bodies_;
  Subdivision subdivision_;
  std::vector<Index> end_of_body_;  // of the bodies with boxes: past their last one
  BoxTable table_;
  ContactSearch search_;
  ScatteredSearch scattered_;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb() { return std::make_unique<MultiLevelSb>(); }

PaperStructure make_paper_structure() {
  return [method = std::make_shared<MultiLevelSb>()](const Frame& frame, const Settings& settings, Workers& workers) {
    Result unused;
    method->build(frame, settings, workers, unused);
    return method->debug();
  };
}

}  // namespace collide::methods
