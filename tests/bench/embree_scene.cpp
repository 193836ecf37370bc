#include "tests/bench/embree_scene.h"

#include <stdexcept>
#include <string>

namespace bench {

void EmbreeContacts::append_to(std::vector<collide::Contact>& contacts) {
  for (List& list : lists_) {
    contacts.insert(contacts.end(), list.begin(), list.end());
    list.clear();
  }
}

void EmbreeScene::update(std::size_t count, int threads, RTCBoundsFunction bounds, void* user) {
  if (threads != threads_ || count != count_) start(count, threads);
  rtcSetGeometryUserData(geometry_, user);
  rtcSetGeometryBoundsFunction(geometry_, bounds, user);
  rtcCommitGeometry(geometry_);
  rtcCommitScene(scene_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree: the scene was refused");
}

void EmbreeScene::start(std::size_t count, int threads) {
  release();
  count_ = count;
  threads_ = threads;
  std::string config("threads=");
  device_ = rtcNewDevice(config.append(std::to_string(threads)).c_str());
  if (!device_) throw std::runtime_error("Embree: no device");
  scene_ = rtcNewScene(device_);
  // Of all flags and qualities these build fastest; a better hierarchy costs more than it saves in one query.
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryBuildQuality(geometry_, update_ == Update::refit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
  rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(count));
  rtcAttachGeometryByID(scene_, geometry_, 0);
}

void EmbreeScene::release() {
  if (!device_) return;
  rtcReleaseGeometry(geometry_);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

}  // namespace bench
