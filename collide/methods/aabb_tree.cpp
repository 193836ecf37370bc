// A tree of boxes for each body, refitted in every frame (van den Bergen 1997), and one over the bodies, built anew.

#include <algorithm>
#include <numeric>

#include "collide/core/body_boxes.h"
#include "collide/core/cutoff.h"
#include "collide/methods/detectors.h"
#include "collide/trees/body_trees.h"

namespace collide::methods {

namespace {

class AabbTree final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    trees_.update(frame, bodies_.live, workers);
    build_upper();
    result.counters.boxes = trees_.nodes().size();
    constexpr double test_ns = 50;  // of work, of a vertex
    search_.begin(frame, settings, trees_.points(), workers.threads_for(test_ns * trees_.points().size()));
    search_tree(trees_.nodes(), settings.self_collision, contact_cutoff(settings.tolerance), search_, workers);
    search_.finish(result);
  }

  void forget() override { trees_.forget(); }

 private:
  void build_upper() {
    const std::span<trees::Node> upper = trees_.upper();
    if (upper.empty()) return;
    order_.resize(bodies_.live.size());
    std::iota(order_.begin(), order_.end(), Index{0});
    Index used = 1;
    build_upper(upper, 0, used, order_);
  }

  /// Makes a node over some bodies: cut at the median across the axis along which their centres are spread widest.
  void build_upper(std::span<trees::Node> upper, Index node, Index& used, std::span<Index> bodies) {
    if (bodies.size() == 1) {
      upper[node] = trees_.nodes_of(bodies.front()).front();
      return;
    }
    const auto centre = [&](Index k) {
      const Aabb& box = trees_.nodes_of(k).front().box;
      return box.lo * 0.5f + box.hi * 0.5f;
    };
    const auto [lo, hi] = box_around(0, bodies.size(), [&](std::size_t k) { return centre(bodies[k]); });
    const int axis = longest_axis(hi * 0.5f - lo * 0.5f);
    const auto low = bodies.size() / 2;
    std::ranges::nth_element(bodies, bodies.begin() + static_cast<std::ptrdiff_t>(low), {},
                             [&](Index k) { return centre(k)[axis]; });
    const Index child = used;
    used += 2;
    build_upper(upper, child, used, bodies.first(low));
    build_upper(upper, child + 1, used, bodies.subspan(low));
    const trees::Node &one = upper[child], &other = upper[child + std::size_t{1}];
    upper[node] = {joint(one.box, other.box), child, 2, one.size + other.size, false};
  }

  BodyBoxes bodies_;
  trees::BodyTrees trees_;
  std::vector<Index> order_;  // of the live bodies
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_aabb_tree() { return std::make_unique<AabbTree>(); }

}  // namespace collide::methods
