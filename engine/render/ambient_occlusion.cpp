#include "engine/render/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace engine::render {
namespace {

constexpr float occluder_range = 1.2f;  // radii: a sphere farther from a surface hides nothing (ambient.glsl)

/// True if `occluder` can hide part of the sky from `receiver`, a body with vertices up to `reach` from its centre. It
/// counts as somewhat larger, because it bulges between them. Few vertices are farther than 1.5 mean radii.
bool occludes(const glm::vec4& occluder, const glm::vec4& receiver, float reach) {
  return glm::distance(glm::vec3(occluder), glm::vec3(receiver)) <
         std::min(1.1f * reach, 1.5f * receiver.w) + (1.0f + occluder_range) * occluder.w;
}

/// Returns the distance (m) of the farthest position from `centre`.
float max_distance(const glm::vec3& centre, std::span<const glm::vec3> positions) {
  float squared = 0.0f;
  for (const glm::vec3& position : positions) {
    const glm::vec3 offset = position - centre;
    squared = std::max(squared, glm::dot(offset, offset));
  }
  return std::sqrt(squared);
}

bool finite(const glm::vec4& sphere) {
  return std::isfinite(sphere.x) && std::isfinite(sphere.y) && std::isfinite(sphere.z) && std::isfinite(sphere.w);
}

}  // namespace

glm::vec4 mean_sphere(std::span<const glm::vec3> positions) {
  if (positions.empty()) return glm::vec4(0.0f);
  const auto count = static_cast<float>(positions.size());
  const glm::vec3 centre = std::accumulate(positions.begin(), positions.end(), glm::vec3(0.0f)) / count;
  float radius = 0.0f;
  for (const glm::vec3& position : positions) radius += glm::distance(position, centre);
  const glm::vec4 sphere(centre, radius / count);
  return finite(sphere) ? sphere : glm::vec4(0.0f);
}

void AmbientOcclusion::update(const FrameData& frame) {
  spheres_.clear();
  reaches_.clear();
  for (const MeshDraw& draw : frame.meshes) {
    const auto positions = frame.positions.subspan(draw.first_vertex, draw.vertex_count);
    const glm::vec4& sphere = spheres_.emplace_back(mean_sphere(positions));
    reaches_.push_back(max_distance(glm::vec3(sphere), positions));
  }
  for (const Sphere& sphere : frame.spheres) {
    spheres_.emplace_back(sphere.centre, sphere.radius);
    reaches_.push_back(sphere.radius);
  }
  find_pairs();
  occluders_.clear();
  ranges_.assign(spheres_.size(), {});
  for (const Pair& pair : pairs_) ++ranges_[pair.receiver].count;
  std::uint32_t first = 0;
  for (OccluderRange& range : ranges_) {
    range.first = first;
    first += std::exchange(range.count, 0);
  }
  occluders_.resize(first);
  for (const Pair& pair : pairs_) {
    OccluderRange& range = ranges_[pair.receiver];
    occluders_[range.first + range.count++] = spheres_[pair.occluder];
  }
}

/// Sorts the spheres into columns along x that are as wide as any two of them can act, and sweeps along x through each
/// column together with itself and its neighbours: only spheres that are near each other are compared.
void AmbientOcclusion::find_pairs() {
  pairs_.clear();
  places_.clear();
  float largest = 0.0f;
  for (const glm::vec4& sphere : spheres_) largest = std::max(largest, sphere.w);
  if (largest <= 0.0f) return;
  const float range = (2.5f + occluder_range) * largest;
  for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
    const glm::vec4& sphere = spheres_[i];
    places_.push_back({{std::floor(sphere.y / range), std::floor(sphere.z / range)}, sphere.x, i});
  }
  std::ranges::sort(places_);
  for (auto begin = places_.begin(); begin != places_.end();) {
    const Column column = begin->column;
    const auto end = std::ranges::upper_bound(begin, places_.end(), column, {}, &Place::column);
    for (auto a = begin; a != end; ++a) compare(*a, a + 1, end, range);
    for (const auto& [y, z] : {Column{0, 1}, Column{1, -1}, Column{1, 0}, Column{1, 1}}) {
      const Column beside{column[0] + y, column[1] + z};
      auto other = std::ranges::lower_bound(end, places_.end(), beside, {}, &Place::column);
      const auto other_end = std::ranges::upper_bound(other, places_.end(), beside, {}, &Place::column);
      for (auto a = begin; a != end; ++a) {
        while (other != other_end && other->x < a->x - range) ++other;
        compare(*a, other, other_end, range);
      }
    }
    begin = end;
  }
}

/// Compares a place with those from `other` on; these ascend along x.
void AmbientOcclusion::compare(const Place& place, Places::const_iterator other, Places::const_iterator end,
                               float range) {
  const std::uint32_t a = place.sphere;
  for (; other != end && other->x <= place.x + range; ++other) {
    const std::uint32_t b = other->sphere;
    if (occludes(spheres_[a], spheres_[b], reaches_[b])) pairs_.push_back({b, a});
    if (occludes(spheres_[b], spheres_[a], reaches_[a])) pairs_.push_back({a, b});
  }
}

}  // namespace engine::render
