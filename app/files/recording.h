#pragma once
// Bodies whose motion is recorded, frame by frame.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "softbody/mesh/points.h"
#include "softbody/model/body_model.h"
#include "softbody/scene/scene.h"

namespace app::files {

/// A frame of a recording: the first bodies of the recording, and where their vertices are.
/// Points are in the world, one body after another, and finite.
struct RecordedFrame : softbody::Points {
  std::uint32_t body_count = 0;
};

class Recording {
 public:
  virtual ~Recording() = default;
  /// Returns the lower and the upper corner of a box around the bodies, as far as that is known without all frames.
  virtual std::array<glm::vec3, 2> bounds() const = 0;
  /// Returns the number of frames, at least 1.
  virtual int frame_count() const = 0;
  /// Returns a frame. Precondition: 0 <= number < frame_count(). Throws SceneError if it cannot be read;
  /// other frames can be read nevertheless.
  virtual std::shared_ptr<const RecordedFrame> frame(int number) = 0;
  /// Returns the model of a body, which is the same in all frames. Precondition: a frame with this body was read.
  virtual const std::shared_ptr<const softbody::BodyModel>& model(std::uint32_t body) const = 0;
  /// Frees the memory of frames that can be read again.
  virtual void release() {}
  /// Returns the words by which a command line names the recording.
  virtual std::vector<std::string> command_words() const = 0;
};

/// What is opened: a scene to simulate, or a recording to play.
struct Opened {
  Opened(softbody::Scene s, std::shared_ptr<Recording> r = nullptr) : scene(std::move(s)), recording(std::move(r)) {}

  softbody::Scene scene;                 // with a recording: its names, its view and how its contacts are found
  std::shared_ptr<Recording> recording;  // nullptr: the scene is simulated
};

}  // namespace app::files
