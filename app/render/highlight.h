#pragma once
// Highlights a part of the scene and fades the rest, for a step of the guided tour.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/frame_data.h"
#include "softbody/state/body.h"

namespace app::render {

struct SceneLabel {
  glm::vec3 at;  // m
  std::string text;
  std::optional<glm::vec3> ring{};  // the colour of a ring round the point; its size on the screen is fixed
};

struct Highlight {
  std::set<softbody::BodyId> bodies;  // in their colours; all others are faded
  float opacity = 1;                  // of these; below 1 their inside shows
  bool bodies_hide = true;            // the faces of boxes behind these; false: these are a veil over such faces
  std::vector<engine::BoxSet> boxes;
  std::vector<engine::LineSet> lines;
  std::vector<engine::PointSet> points;
  std::vector<SceneLabel> labels;
  // A sphere that the camera should frame.
  glm::vec3 centre{0.0f};
  float radius = 1;  // m

  bool fades(softbody::BodyId body) const { return !bodies.contains(body); }
};

}  // namespace app::render
