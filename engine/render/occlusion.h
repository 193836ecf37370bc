#pragma once
// Who darkens whom: every body and solid is taken as a sphere, and each gets the list of those near enough to hide part
// of the sky from it. No OpenGL.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/frame_data.h"

namespace engine {

struct Range {
  std::uint32_t first = 0, count = 0;
};

/// The middle of a body's vertices, and their mean distance from it.
glm::vec4 mean_sphere(std::span<const glm::vec3> positions);

/// The largest distance of a position from the centre.
float reach(const glm::vec3& centre, std::span<const glm::vec3> positions);

class Occlusion {
 public:
  /// Spheres of `frame`: first those of its meshes, then its solid ones, in their order.
  void update(const FrameData& frame);

  std::span<const glm::vec4> spheres() const { return spheres_; }
  std::span<const Range> ranges() const { return ranges_; }  // one per sphere, into occluders()
  std::span<const glm::vec4> occluders() const { return occluders_; }

 private:
  void find_neighbours();

  struct Pair {
    std::uint32_t receiver, occluder;
  };
  std::vector<glm::vec4> spheres_, occluders_;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> order_;
  std::vector<Pair> pairs_;
};

}  // namespace engine
