// Embree with a box around every patch.

#include "tests/bench/candidate.h"
#include "tests/bench/embree_scene.h"
#include "tests/bench/patches.h"

namespace bench {
namespace {

class EmbreePatches final : public collide::Detector {
 public:
  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers& workers,
              collide::Result& result) override {
    result = {};
    filter_.begin(frame, settings);
    patches_.update(frame, settings.tolerance);
    scene_.update(patches_.count(), workers.threads(), &bounds, this);
    scene_.collide(&keep, this);
    patches_.test_insides(filter_, result.contacts);
    contacts_.append_to(result.contacts);
    order_.sort(result.contacts, frame.x.size());
  }

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const EmbreePatches*>(arguments->geometryUserPtr);
    const auto& [lo, hi] = self.patches_.box(arguments->primID);
    *arguments->bounds_o = {lo[0], lo[1], lo[2], 0, hi[0], hi[1], hi[2], 0};
  }

  /// Each pair comes in both orders.
  static void keep(void* user, RTCCollision* pairs, unsigned count) {
    auto& self = *static_cast<EmbreePatches*>(user);
    auto& contacts = self.contacts_.local();
    for (unsigned k = 0; k < count; ++k)
      if (pairs[k].primID0 < pairs[k].primID1)
        self.patches_.test(pairs[k].primID0, pairs[k].primID1, self.filter_, contacts);
  }

  EmbreeScene scene_{EmbreeScene::Update::refit};
  Patches<8> patches_;
  ContactFilter filter_;
  EmbreeContacts contacts_;
  ContactOrder order_;
};

}  // namespace

std::unique_ptr<collide::Detector> make_embree_patches() { return std::make_unique<EmbreePatches>(); }

}  // namespace bench
