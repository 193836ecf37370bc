#pragma once
// A recording in memory: balls that move along x, of which the last one joins late.

#include <optional>

#include "app/files/recording.h"
#include "softbody/world/body_model_set.h"

namespace app {

class RecordedBalls : public files::Recording {
 public:
  static constexpr std::uint32_t few = 2, all = 3;  // bodies, before and from frame `late` on
  static constexpr int late = 4;

  explicit RecordedBalls(int frames, double radius = 0.5) : frames_(frames), mesh_(softbody::icosphere(1, radius)) {
    const auto shape = std::make_shared<const collide::Shape>(collide::Index(mesh_.vertices.size()), mesh_.edges);
    model_ = softbody::recorded_body_model(mesh_, shape);
  }

  std::array<glm::vec3, 2> bounds() const override { return {glm::vec3(-0.5f), glm::vec3(1.8f, 0.5f, 0.5f)}; }
  int frame_count() const override { return frames_; }
  std::shared_ptr<const files::RecordedFrame> frame(int number) override {
    if (broken == number) throw softbody::SceneError("frame 3 is broken");
    auto frame = std::make_shared<files::RecordedFrame>();
    frame->body_count = number < late ? few : all;
    for (std::uint32_t body = 0; body < frame->body_count; ++body)
      for (const glm::dvec3& v : mesh_.vertices) {
        frame->x.push_back(static_cast<float>(v.x + (1.3 - 0.05 * number) * body));
        frame->y.push_back(static_cast<float>(v.y + 0.01 * number));
        frame->z.push_back(static_cast<float>(v.z));
      }
    return frame;
  }
  const std::shared_ptr<const softbody::BodyModel>& model(std::uint32_t) const override { return model_; }

  void release() override { ++releases; }
  std::vector<std::string> command_words() const override { return {"--play", "ball 0.obj"}; }

  std::optional<int> broken;
  int releases = 0;

 private:
  int frames_;
  softbody::Mesh mesh_;
  std::shared_ptr<const softbody::BodyModel> model_;
};

/// Returns a recording with a scene to play it in.
inline files::Opened opened(std::shared_ptr<files::Recording> recording) {
  softbody::Scene scene;
  scene.key = scene.name = "balls";
  scene.collision.tolerance = 0.15f;
  return {std::move(scene), std::move(recording)};
}

}  // namespace app
