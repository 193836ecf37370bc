// nanoflann: a k-d tree over all vertices, built anew in every frame, and a radius search around each of them.

#include <nanoflann.hpp>

#include "tests/bench/candidate.h"
#include "tests/bench/contact_list.h"

namespace bench {
namespace {

using collide::Index;

/// What nanoflann asks of a set of points.
struct Cloud {
  std::vector<std::array<float, 3>> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(Index i, std::size_t axis) const { return points[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud, float, Index>, Cloud, 3, Index>;

/// Keeps the contacts of one vertex with later ones, straight from the search.
struct Later {
  using DistanceType = float;
  Index vertex;
  float worst;  // squared, with room for the rounding of the search's bounds
  const ContactFilter& filter;
  std::vector<collide::Contact>& contacts;

  float worstDist() const { return worst; }
  bool full() const { return true; }
  bool addPoint(float distance, Index other) {
    if (other > vertex && distance < filter.tolerance2() && filter.allowed(vertex, other))
      contacts.push_back({vertex, other});
    return true;
  }
};

class Nanoflann final : public collide::Detector {
 public:
  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers& workers,
              collide::Result& result) override {
    result = {};
    filter_.begin(frame, settings);
    const std::size_t count = frame.x.size();
    cloud_.points.resize(count);
    for (std::size_t v = 0; v < count; ++v) cloud_.points[v] = {frame.x[v], frame.y[v], frame.z[v]};
    const Tree tree(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
    found_.resize(std::size_t(workers.threads()));
    workers.run(workers.threads(), [&](int thread) {
      search(tree, collide::part_of(count, thread, workers.threads()), found_[std::size_t(thread)]);
    });
    for (auto& contacts : found_) result.contacts.insert(result.contacts.end(), contacts.begin(), contacts.end());
  }

 private:
  static constexpr std::size_t leaf_size = 16;  // points; of 5, 10, 16, 24 and 40 none is clearly faster

  /// The vertices come in order, so that only the few contacts of each have to be sorted.
  void search(const Tree& tree, collide::Part part, std::vector<collide::Contact>& contacts) const {
    contacts.clear();
    const float worst = 1.0001f * filter_.tolerance2();
    for (std::size_t v = part.begin; v < part.end; ++v) {
      const auto before = std::ptrdiff_t(contacts.size());
      Later later{Index(v), worst, filter_, contacts};
      tree.findNeighbors(later, cloud_.points[v].data(), {});
      std::sort(contacts.begin() + before, contacts.end());
    }
  }

  Cloud cloud_;
  ContactFilter filter_;
  std::vector<std::vector<collide::Contact>> found_;  // a list a thread
};

}  // namespace

std::unique_ptr<collide::Detector> make_nanoflann() { return std::make_unique<Nanoflann>(); }

}  // namespace bench
