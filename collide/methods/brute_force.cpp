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
    workers.run(parts, [&](int part) { test_rows(part, parts, settings.self_collision); });
    search_.finish(result);
  }

 private:
  /// Bodies are dealt to the threads like cards, since each has fewer bodies behind it than the one before.
  void test_rows(int thread, int threads, bool self_collision) {
    const Index count = points_.size();
    for (auto k = static_cast<std::size_t>(thread); k < ranges_.size(); k += static_cast<std::size_t>(threads)) {
      const Range body = ranges_[k];
      if (self_collision) search_.test(thread, body, body);
      search_.test(thread, body, {body.end, count});
    }
  }

  BodyBoxes bodies_;
  Points points_;
  std::vector<Range> ranges_;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_brute_force() { return std::make_unique<BruteForce>(); }

}  // namespace collide::methods
