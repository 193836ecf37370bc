// Embree: a bounding volume hierarchy over all vertices, each a box padded by half of the tolerance, collided with
// itself. Boxes that overlap are pairs of candidates.

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/bench/candidate.h"
#include "tests/bench/contact_list.h"

namespace bench {
namespace {

class Embree final : public collide::Detector {
 public:
  explicit Embree(bool refits) : refits_(refits) {}
  ~Embree() override { release(); }

  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers& workers,
              collide::Result& result) override {
    if (workers.threads() != threads_ || frame.x.size() != count_) start(frame.x.size(), workers.threads());
    result = {};
    frame_ = frame;
    // Half of the tolerance, and room for the rounding of the two sums and of the distance.
    pad_ = 0.5f * settings.tolerance * 1.00001f;
    filter_.begin(frame, settings);
    contacts_ = &result.contacts;
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    rtcCollide(scene_, scene_, &keep, this);
    std::sort(result.contacts.begin(), result.contacts.end());
  }

 private:
  void start(std::size_t count, int threads) {
    release();
    count_ = count;
    threads_ = threads;
    const std::string config = "threads=" + std::to_string(threads) + ",user_threads=" + std::to_string(threads);
    device_ = rtcNewDevice(config.c_str());
    if (!device_) throw std::runtime_error("Embree: no device");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, refits_ ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, refits_ ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(count));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, &bounds, this);
    rtcAttachGeometryByID(scene_, geometry_, 0);
  }

  void release() {
    if (!device_) return;
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const Embree& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    const unsigned v = arguments->primID;
    const auto& [x, y, z, bodies] = self.frame_;
    *arguments->bounds_o = {x[v] - self.pad_, y[v] - self.pad_, z[v] - self.pad_, 0,
                            x[v] + self.pad_, y[v] + self.pad_, z[v] + self.pad_, 0};
  }

  static void keep(void* user, RTCCollision* pairs, unsigned count) {
    Embree& self = *static_cast<Embree*>(user);
    for (unsigned k = 0; k < count; ++k) {
      const collide::Index a = pairs[k].primID0, b = pairs[k].primID1;
      if (a < b && self.filter_.contact(a, b)) self.contacts_->push_back({a, b});
    }
  }

  const bool refits_;
  std::size_t count_ = 0;
  int threads_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;
  collide::Frame frame_;
  float pad_ = 0;
  ContactFilter filter_;
  std::vector<collide::Contact>* contacts_ = nullptr;
};

}  // namespace

std::unique_ptr<collide::Detector> make_embree_rebuild() { return std::make_unique<Embree>(false); }
std::unique_ptr<collide::Detector> make_embree_refit() { return std::make_unique<Embree>(true); }

}  // namespace bench
