// Multi-Level SB Collide made exact, and kept to where bodies can touch. Of every two bodies whose boxes (§2.1) and
// spheres come near each other, only the vertices that face the other body along the line of centres are looked at or,
// if these are many, patches that come near it. Inside a body its patches are looked at, unless it is proven that it
// cannot touch itself. No hash: what is near a body is found by strips. Bodies that have not moved since the last frame
// keep the contacts among them.

#include "collide/exact/multi_level_sb_exact.h"
#include "collide/exact/body_pair_search.h"

namespace collide::exact {

namespace {

class MultiLevelSbExact final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    result.start();
    search_.find_bounds(frame, workers, result.non_finite_bodies);
    resting_.observe(frame, settings, search_.bounds(), workers);
    search_.find(frame, settings, resting_, workers);
    search_.concatenate(workers, result.contacts);
    search_.count(result);
    resting_.store(frame, search_.near(), result.contacts);
  }

  void forget() override {
    search_.forget();
    resting_.forget();
  }

  /// Where the last search looked.
  DebugGeometry debug() const override {
    DebugGeometry geometry;
    geometry.boxes = search_.boxes();
    geometry.box_first.assign(geometry.boxes.size() + 1, 0);
    return geometry;
  }

 private:
  BodyPairSearch search_;
  RestingContacts resting_;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb_exact() { return std::make_unique<MultiLevelSbExact>(); }

}  // namespace collide::exact
