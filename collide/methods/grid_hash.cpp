// The rival "Grid Hash": every vertex of every body is hashed, and no box is built.

#include "collide/methods/detectors.h"
#include "collide/methods/vertex_grid.h"

namespace collide::methods {

namespace {

class GridHash final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    grid_.detect(frame, bodies_.live, settings, workers, result);
  }

  DebugGeometry debug() const override { return grid_.debug(); }

 private:
  BodyBoxes bodies_;
  VertexGrid grid_;
};

}  // namespace

std::unique_ptr<Detector> make_grid_hash() { return std::make_unique<GridHash>(); }

}  // namespace collide::methods
