// Multi-Level SB Collide made exact, and kept to where bodies can touch. Of every two bodies whose boxes (§2.1) and
// spheres come near each other, only the vertices that face the other body along the line of centres are looked at; the
// area that they fill is subdivided level by level (§5) as long as that pays. Inside a body all pairs are looked at, by
// the same tree, unless it is proven that it cannot touch itself. No hash: what is near a body is found by strips.
// While bodies move little, what an earlier frame has found says where to look.

#include "collide/contact_memory.h"
#include "collide/detectors.h"

namespace collide {

namespace {

constexpr std::size_t max_contacts = std::size_t{1} << 27;  // 1 GiB of them

class MultiLevelSbExact final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    result.start();
    if (memory_.recall(frame, settings, search_, workers, result)) return;
    result.start();  // without what was tried
    search_.bound(frame, workers, result.non_finite_bodies);
    search_.find(frame,
                 {.distance = settings.tolerance,
                  .tolerance = settings.tolerance,
                  .self = settings.self_collision,
                  .levels = settings.levels,
                  .most_pairs = max_contacts},
                 workers);
    search_.concatenate(workers, result.contacts);
    search_.count(result);
    memory_.watch(frame, result, workers);
  }

  void forget() override {
    search_.forget();
    memory_.forget();
  }

  /// Where the last search looked: while candidates are remembered, that was when some were listed.
  DebugGeometry debug() const override {
    DebugGeometry geometry;
    geometry.boxes = search_.boxes();
    geometry.box_first.assign(geometry.boxes.size() + 1, 0);
    return geometry;
  }

 private:
  GroupSearch search_;
  ContactMemory memory_;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb_exact() { return std::make_unique<MultiLevelSbExact>(); }

}  // namespace collide
