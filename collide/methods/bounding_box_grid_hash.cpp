// The rival "Bounding Box + Grid Hash": only bodies whose box overlaps another body's have their vertices hashed. With
// self-collision that is every body, since each overlaps itself.

#include "collide/core/cutoff.h"
#include "collide/methods/detectors.h"
#include "collide/methods/vertex_grid.h"

namespace collide::methods {

namespace {

class BoundingBoxGridHash final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    result.counters.boxes = bodies_.live.size();
    touching_.clear();
    for (const BodyPair& pair : pairs_.find(bodies_, contact_cutoff(settings.tolerance))) {
      touching_.insert(touching_.end(), {pair.a, pair.b});
    }
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
    grid_.detect(frame, settings.self_collision ? bodies_.live : touching_, settings, workers, result);
  }

  DebugGeometry debug() const override { return grid_.debug(); }

 private:
  BodyBoxes bodies_;
  BodyPairs pairs_;
  std::vector<Index> touching_;
  VertexGrid grid_;
};

}  // namespace

std::unique_ptr<Detector> make_bounding_box_grid_hash() { return std::make_unique<BoundingBoxGridHash>(); }

}  // namespace collide::methods
