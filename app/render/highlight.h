#pragma once
// What stands out in the scene at a step of the guided tour, while everything else fades.

#include <string>
#include <vector>

#include "engine/frame_data.h"
#include "softbody/dynamics.h"

namespace app {

struct SceneLabel {
  glm::vec3 at;  // m
  std::string text;
};

struct Highlight {
  std::vector<softbody::BodyId> bodies;  // drawn in their colours; all others are drawn faintly
  float opacity = 1;                     // of these bodies: below 1 their insides can be seen
  std::vector<engine::BoxSet> boxes;
  std::vector<engine::LineSet> lines;
  std::vector<engine::PointSet> points;
  std::vector<SceneLabel> labels;
  // The sphere that the camera should frame.
  glm::vec3 centre{0.0f};
  float radius = 1;  // m
};

}  // namespace app
