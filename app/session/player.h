#pragma once
// Plays recorded frames, in place of a world that simulates.

#include <memory>

#include "app/files/playback.h"
#include "collide/core/workers.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::session {

/// Shows the frames of a recording and finds their contacts.
class Player : public softbody::BodiesInMotion {
 public:
  /// Shows the first frame. Of `scene`, bodies and solids do not count. Throws as show() does.
  Player(std::shared_ptr<files::Playback> recording, softbody::Scene scene, int threads);

  /// Shows the next frame, and after the last one the first one. Throws as show(); the next call then goes on behind
  /// the frame that cannot be read.
  void step();
  /// Shows a frame and detects. Throws as Playback::frame() does, and then shows what it did before. If it is the
  /// detector that throws, the frame is shown, but detection() is not of it.
  void show(int number);
  /// Makes `scene` the scene, and detects anew. Changes nothing if it throws: SceneError for settings that are not
  /// allowed or take too long in a frame, or what the detector throws.
  void apply(const softbody::Scene& scene);
  /// Frees the memory of the detection, until apply() is called.
  void forget_detection();

  const std::shared_ptr<files::Playback>& recording() const { return recording_; }
  /// Returns the memory of the frame that is shown, in bytes.
  std::size_t bytes() const { return 3 * sizeof(float) * shown_->x.size(); }

  const softbody::Scene& scene() const override { return scene_; }
  const collide::Settings& collision() const override { return settings_; }
  glm::vec3 automatic_cell_size(int levels) const override { return automatic_cell_size(levels, settings_.tolerance); }
  const collide::Method& method() const override { return *method_; }
  std::optional<std::array<glm::vec3, 2>> bounds() const override { return recording_->bounds(); }
  int frame() const override { return frame_; }
  double frame_time() const override { return 1.0 / 60; }
  const softbody::StepReport& last_step() const override { return report_; }
  bool all_at_rest() const override { return recording_->frame_count() == 1; }
  const collide::Bodies& bodies() const override { return bodies_; }
  collide::Frame positions() const override { return {shown_->x, shown_->y, shown_->z, &bodies_}; }
  softbody::SimulatedMeshes simulated() const override { return {positions(), result_.contacts}; }
  softbody::BodyState body(softbody::BodyId body) const override { return {.number = body}; }
  const softbody::BodyModel& model(softbody::BodyId body) const override { return *recording_->model(body); }
  const collide::Result& detection() const override { return result_; }
  const collide::Detector& detector() const override { return *detector_; }

 private:
  glm::vec3 automatic_cell_size(int levels, float tolerance) const;
  collide::Settings settings_of(const softbody::Scene& scene) const;

  std::shared_ptr<files::Playback> recording_;
  softbody::Scene scene_;
  collide::Settings settings_;
  const collide::Method* method_;
  collide::Workers workers_;
  std::shared_ptr<const files::RecordedFrame> shown_;
  int frame_ = 0, tried_ = 0;  // tried_: the last frame to be shown; one that cannot be read is not frame_
  collide::Bodies bodies_;
  std::unique_ptr<collide::Detector> detector_;
  collide::Result result_;
  softbody::StepReport report_;
};

}  // namespace app::session
