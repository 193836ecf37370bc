#pragma once
// Deforming bodies: one instanced draw per mesh and refinement. The shader fetches a body's vertices from textures, so
// a frame uploads positions and normals as they are, and finer outlines cost no upload.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/render/occlusion.h"

namespace engine {

/// Meshes of bodies, each in a few levels of refinement: every level cuts each triangle into four.
class Bodies {
 public:
  static constexpr int levels = 3;

  explicit Bodies(const std::filesystem::path& shaders);

  MeshHandle add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count);
  /// Throws std::invalid_argument for a draw that does not fit its mesh or the vertices.
  void check(const FrameData& frame) const;

  /// Uploads a frame seen from `eye`; what is 1 m large and 1 m away covers `pixels_at_one_metre`.
  void update(const FrameData& frame, const Occlusion& occlusion, const glm::vec3& eye, float pixels_at_one_metre);
  void draw_shadows(const glm::mat4& light_clip);
  void draw();
  /// After all that is solid. They hide one another, and what comes later, as if they were.
  void draw_translucent();

 private:
  void check(const MeshDraw& draw, const FrameData& frame) const;

  struct Instance {
    std::uint32_t first_vertex;
    float radius;
    Range occluders;
    glm::vec3 colour;
  };
  struct Level {
    VertexArray array;
    Buffer vertices, indices;
    GLsizei index_count = 0;
  };
  struct Mesh {
    std::vector<std::uint32_t> triangles;
    std::uint32_t vertex_count = 0;
    bool closed = false;
    std::array<std::unique_ptr<Level>, levels> refined;  // made when first needed: each has four times the triangles
  };
  using Batches = std::map<std::pair<std::uint32_t, int>, std::vector<Instance>,
                           std::greater<>>;  // by mesh and level, finest first

  void collect(const FrameData& frame, const Occlusion& occlusion, const glm::vec3& eye, float pixels_at_one_metre);
  void collect_translucent(const FrameData& frame, const glm::vec3& eye, float pixels_at_one_metre);
  void draw_batches(const Batches& batches, bool coarse);
  const Level& level_of(Mesh& mesh, int level) const;
  void describe_instances() const;

  Program program_, shadow_program_;
  std::vector<Mesh> meshes_;
  Batches batches_;
  std::vector<std::pair<const TranslucentSet*, Batches>> translucent_;  // of the frame at hand
  std::vector<std::pair<float, std::uint32_t>> distances_;              // of each body from the eye
  Buffer position_buffer_, normal_buffer_, occluder_buffer_, instances_;
  Texture positions_, normals_, occluders_;
};

}  // namespace engine
