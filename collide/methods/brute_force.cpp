// Every vertex against every other: the exact reference that all methods are measured against.

#include "collide/core/body_boxes.h"
#include "collide/core/contact_search.h"
#include "collide/methods/detectors.h"

namespace collide::methods {

namespace {

class BruteForce final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    points_.gather(frame, bodies_.live, ranges_);
    constexpr double test_ns = 0.15;  // of work
    const auto vertices = static_cast<double>(points_.size());
    const int parts = workers.threads_for(test_ns * vertices * vertices / 2);
    search_.begin(frame, settings, points_, parts);
    workers.share(parts, ranges_.size(), [&](int thread, std::size_t k) {
      if (settings.self_collision) search_.test(thread, ranges_[k], ranges_[k]);
      search_.test(thread, ranges_[k], {ranges_[k].end, points_.size()});
    });
    search_.finish(result);
  }

 private:
  BodyBoxes bodies_;
  Points points_;
  std::vector<Range> ranges_;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_brute_force() { return std::make_unique<BruteForce>(); }

}  // namespace collide::methods
