#pragma once
// Ambient occlusion between bodies and solids. Each is treated as a sphere and gets a list of the spheres that hide
// part of the sky from it. No OpenGL.

#include <array>
#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/frame_data.h"

namespace engine::render {

/// Part of a list of occluders.
struct OccluderRange {
  std::uint32_t first = 0, count = 0;
};

/// Returns the mean of the positions (xyz) and their mean distance from it (w, m). Returns zeros if there are no
/// positions or if one is not finite.
glm::vec4 mean_sphere(std::span<const glm::vec3> positions);

class AmbientOcclusion {
 public:
  /// Takes the spheres of a frame: first those of its meshes, then its solid spheres, each in the order of the frame.
  void update(const FrameData& frame);

  std::span<const glm::vec4> spheres() const { return spheres_; }
  std::span<const float> reaches() const { return reaches_; }        // one per sphere: m to the farthest vertex
  std::span<const OccluderRange> ranges() const { return ranges_; }  // one per sphere, into occluders()
  std::span<const glm::vec4> occluders() const { return occluders_; }

 private:
  using Column = std::array<float, 2>;  // y and z, in units of its width
  struct Place {
    Column column;
    float x;
    std::uint32_t sphere;
    auto operator<=>(const Place&) const = default;
  };
  using Places = std::vector<Place>;
  struct Pair {
    std::uint32_t receiver, occluder;
  };
  void find_pairs();
  void compare(const Place& place, Places::const_iterator other, Places::const_iterator end, float range);

  std::vector<glm::vec4> spheres_, occluders_;
  std::vector<float> reaches_;
  std::vector<OccluderRange> ranges_;
  Places places_;  // of all spheres, by column, then by x
  std::vector<Pair> pairs_;
};

}  // namespace engine::render
