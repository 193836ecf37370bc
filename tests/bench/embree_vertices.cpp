// Embree with a box around every vertex: two vertices in contact have boxes that overlap.

#include "tests/bench/candidate.h"
#include "tests/bench/contact_list.h"
#include "tests/bench/embree_scene.h"

namespace bench {
namespace {

class EmbreeVertices final : public collide::Detector {
 public:
  explicit EmbreeVertices(EmbreeScene::Update update) : scene_(update) {}

  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers& workers,
              collide::Result& result) override {
    result = {};
    frame_ = frame;
    pad_ = half_of(settings.tolerance);
    filter_.begin(frame, settings);
    scene_.update(frame.x.size(), workers.threads(), &bounds, this);
    scene_.collide(&keep, this);
    contacts_.append_to(result.contacts);
    order_.sort(result.contacts, frame.x.size());
  }

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const EmbreeVertices*>(arguments->geometryUserPtr);
    const auto& [x, y, z, bodies] = self.frame_;
    const unsigned v = arguments->primID;
    const float pad = self.pad_;
    *arguments->bounds_o = {x[v] - pad, y[v] - pad, z[v] - pad, 0, x[v] + pad, y[v] + pad, z[v] + pad, 0};
  }

  /// Each pair comes in both orders.
  static void keep(void* user, RTCCollision* pairs, unsigned count) {
    auto& self = *static_cast<EmbreeVertices*>(user);
    auto& contacts = self.contacts_.local();
    for (unsigned k = 0; k < count; ++k) {
      const collide::Index a = pairs[k].primID0, b = pairs[k].primID1;
      if (a < b && self.filter_.contact(a, b)) contacts.push_back({a, b});
    }
  }

  EmbreeScene scene_;
  collide::Frame frame_;
  float pad_ = 0;
  ContactFilter filter_;
  EmbreeContacts contacts_;
  ContactOrder order_;
};

}  // namespace

std::unique_ptr<collide::Detector> make_embree_rebuild() {
  return std::make_unique<EmbreeVertices>(EmbreeScene::Update::rebuild);
}
std::unique_ptr<collide::Detector> make_embree_refit() {
  return std::make_unique<EmbreeVertices>(EmbreeScene::Update::refit);
}

}  // namespace bench
