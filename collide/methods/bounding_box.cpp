// The rival "Bounding Box": bodies whose boxes overlap have all their vertices tested against each other.

#include "collide/core/body_boxes.h"
#include "collide/core/contact_search.h"
#include "collide/core/cutoff.h"
#include "collide/methods/detectors.h"

namespace collide::methods {

namespace {

class BoundingBox final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    result.counters.boxes = bodies_.live.size();
    points_.gather(frame, bodies_.live, slots_);
    by_body_.resize(frame.bodies->count());
    for (std::size_t k = 0; k < slots_.size(); ++k) by_body_[bodies_.live[k]] = slots_[k];
    const std::vector<BodyPair>& pairs = pairs_.find(bodies_, contact_cutoff(settings.tolerance));

    constexpr double test_ns = 0.15;  // of work
    const double mean =
        static_cast<double>(points_.size()) / static_cast<double>(std::max<std::size_t>(slots_.size(), 1));
    const auto body_pairs = static_cast<double>(pairs.size() + (settings.self_collision ? slots_.size() : 0));
    const int parts = workers.threads_for(test_ns * mean * mean * body_pairs);
    search_.begin(frame, settings, points_, parts);
    workers.share(parts, pairs.size(),
                  [&](int thread, std::size_t k) { search_.test(thread, by_body_[pairs[k].a], by_body_[pairs[k].b]); });
    if (settings.self_collision)
      workers.share(parts, slots_.size(),
                    [&](int thread, std::size_t k) { search_.test(thread, slots_[k], slots_[k]); });
    search_.finish(result);
  }

 private:
  BodyBoxes bodies_;
  BodyPairs pairs_;
  Points points_;
  std::vector<Range> slots_, by_body_;  // of the live bodies, and of all
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_bounding_box() { return std::make_unique<BoundingBox>(); }

}  // namespace collide::methods
