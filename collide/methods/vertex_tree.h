#pragma once
// A tree over all vertices, built anew in every frame and compared with itself: what the k-d tree and the octree share.

#include "collide/core/body_boxes.h"
#include "collide/core/cutoff.h"
#include "collide/trees/point_tree.h"

namespace collide::methods {

class VertexTree final : public Detector {
 public:
  explicit VertexTree(trees::Cut cut) : cut_(cut) {}

  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    tree_.build(frame, bodies_.live, cut_, leaf_size, workers);
    constexpr double test_ns = 50;  // of work, of a vertex
    search_.begin(frame, settings, tree_.points(), workers.threads_for(test_ns * tree_.points().size()));
    search_tree(tree_.nodes(), settings.self_collision, contact_cutoff(settings.tolerance), search_, workers);
    search_.finish(result);
  }

 private:
  static constexpr Index leaf_size = 24;  // vertices
  trees::Cut cut_;
  BodyBoxes bodies_;
  trees::PointTree tree_;
  ContactSearch search_;
};

}  // namespace collide::methods
