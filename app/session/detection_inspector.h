#pragma once
// What is shown of the detection on the current positions: boxes, hash table, a bucket and its cells, areas of search.

#include "app/compare/table_contents.h"
#include "app/session/simulation.h"
#include "collide/methods/detectors.h"

namespace app::session {

/// Works things out when they are first asked for, once for each revision() of the simulation.
class DetectionInspector {
 public:
  /// half: whose world is inspected; the first one while there is no second.
  explicit DetectionInspector(const Simulation& simulation, Half half = Half::first);

  /// The method whose boxes, cells and buckets are shown: the driving one if it has a hash table, else the paper's.
  const collide::Method& shown_method() const;
  const collide::DebugGeometry& shown_geometry() const;
  /// Returns the geometry of the paper's method, whichever method drives. It is empty while more bodies move than can
  /// be worked out for each picture.
  const collide::DebugGeometry& paper_geometry() const;
  const compare::TableContents& table() const;
  /// Returns the fullest bucket of every `run` buckets of the table, which must be known; the first one of equals.
  const std::vector<collide::BucketLoad>& fullest_buckets(std::uint32_t run) const;

  /// Returns the bucket whose boxes the scene shows. It is below the number of buckets, since the Session selects it
  /// again when this number changes.
  const std::optional<std::uint32_t>& selected_bucket() const { return selected_bucket_; }
  void select_bucket(std::optional<std::uint32_t> bucket);
  /// The contents of the selected bucket; nullptr if none is selected, or its table is not known.
  const compare::BucketContents* bucket() const;
  /// The cell of that bucket from which true sharing is seen: the one chosen, or else the fullest.
  void select_cell(const compare::Cell& cell) { selected_cell_ = cell; }
  const std::optional<compare::Cell>& selected_cell() const { return selected_cell_; }

  /// Where the exact method looks for contacts if it knows nothing from earlier frames.
  std::vector<collide::DebugGeometry::Box> search_areas() const;
  /// Surface contacts of the last step; empty unless the contact surface is the surfaces.
  const std::vector<softbody::SurfaceContactPoint>& surface_contacts() const;

 private:
  template <class Value>
  struct Cached {
    std::uint64_t revision = 0;
    Value value{};
  };

  const softbody::BodiesInMotion& world() const { return simulation_.world(half_); }

  const Simulation& simulation_;
  Half half_;
  std::unique_ptr<collide::Detector> exact_;  // shows its areas
  mutable collide::methods::PaperStructure paper_structure_ = collide::methods::make_paper_structure();
  std::optional<std::uint32_t> selected_bucket_;
  std::optional<compare::Cell> selected_cell_;
  mutable Cached<collide::DebugGeometry> shown_, paper_;
  mutable Cached<compare::TableContents> table_;
  mutable Cached<std::vector<collide::BucketLoad>> fullest_;
  mutable std::uint32_t fullest_of_ = 0;  // buckets each
  mutable Cached<compare::BucketContents> bucket_;
  mutable Cached<std::vector<softbody::SurfaceContactPoint>> surface_contacts_;
};

}  // namespace app::session
