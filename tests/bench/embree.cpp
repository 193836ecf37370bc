// Embree: a bounding volume hierarchy over boxes that move, collided with itself. The boxes are around every vertex, or
// around every patch.

#include <embree3/rtcore.h>
#include <tbb/enumerable_thread_specific.h>

#include <stdexcept>
#include <string>

#include "tests/bench/candidate.h"
#include "tests/bench/patches.h"

namespace bench {
namespace {

/// A box around every vertex: two vertices in contact have boxes that overlap.
class VertexBoxes {
 public:
  void update(const collide::Frame& frame, float tolerance) {
    frame_ = frame;
    pad_ = half_of(tolerance);
  }
  std::size_t count() const { return frame_.x.size(); }
  Box box(collide::Index v) const {
    const auto& [x, y, z, bodies] = frame_;
    return {{x[v] - pad_, y[v] - pad_, z[v] - pad_}, {x[v] + pad_, y[v] + pad_, z[v] + pad_}};
  }
  void test(collide::Index a, collide::Index b, const ContactFilter& filter,
            std::vector<collide::Contact>& contacts) const {
    if (filter.contact(a, b)) contacts.push_back({a, b});
  }
  void test_insides(const ContactFilter&, std::vector<collide::Contact>&) const {}

 private:
  collide::Frame frame_;
  float pad_ = 0;
};

/// The way the hierarchy follows the boxes from frame to frame.
enum class Update { rebuild, refit };

/// Boxes: VertexBoxes or Patches.
template <class Boxes>
class Embree final : public collide::Detector {
 public:
  explicit Embree(Update update) : update_(update) {}
  ~Embree() override { release(); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers& workers,
              collide::Result& result) override {
    result = {};
    filter_.begin(frame, settings);
    boxes_.update(frame, settings.tolerance);
    if (workers.threads() != threads_ || boxes_.count() != count_) start(workers.threads());
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, &bounds, this);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree: the scene was refused");
    rtcCollide(scene_, scene_, &keep, this);
    boxes_.test_insides(filter_, result.contacts);
    for (List& list : found_) {
      result.contacts.insert(result.contacts.end(), list.begin(), list.end());
      list.clear();
    }
    order_.sort(result.contacts, frame.x.size());
  }

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    const auto& [lo, hi] = self.boxes_.box(arguments->primID);
    *arguments->bounds_o = {lo[0], lo[1], lo[2], 0, hi[0], hi[1], hi[2], 0};
  }

  /// Tests pairs of boxes that may overlap, each of which comes in both orders; on several threads at a time.
  static void keep(void* user, RTCCollision* pairs, unsigned count) {
    auto& self = *static_cast<Embree*>(user);
    List& contacts = self.found_.local();
    for (unsigned k = 0; k < count; ++k)
      if (pairs[k].primID0 < pairs[k].primID1)
        self.boxes_.test(pairs[k].primID0, pairs[k].primID1, self.filter_, contacts);
  }

  void start(int threads) {
    release();
    count_ = boxes_.count();
    threads_ = threads;
    device_ = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    if (!device_) throw std::runtime_error("Embree: no device");
    scene_ = rtcNewScene(device_);
    // Of all flags and qualities these build fastest; a better hierarchy costs more than it saves in one query.
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, update_ == Update::refit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(count_));
    rtcAttachGeometryByID(scene_, geometry_, 0);
  }

  void release() {
    if (!device_) return;
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  using List = std::vector<collide::Contact>;

  const Update update_;
  Boxes boxes_;
  ContactFilter filter_;
  ContactOrder order_;
  tbb::enumerable_thread_specific<List, tbb::cache_aligned_allocator<List>, tbb::ets_key_per_instance> found_;
  std::size_t count_ = 0;
  int threads_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;
};

}  // namespace

std::unique_ptr<collide::Detector> make_embree_rebuild() {
  return std::make_unique<Embree<VertexBoxes>>(Update::rebuild);
}
std::unique_ptr<collide::Detector> make_embree_refit() { return std::make_unique<Embree<VertexBoxes>>(Update::refit); }
std::unique_ptr<collide::Detector> make_embree_patches() { return std::make_unique<Embree<Patches<8>>>(Update::refit); }

}  // namespace bench
