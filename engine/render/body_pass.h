#pragma once
// Draws deforming bodies: one instanced draw per mesh and level of detail. The shader fetches a body's vertices from
// textures, so a frame uploads only positions and normals, at any level of detail.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/program.h"
#include "engine/render/ambient_occlusion.h"

namespace engine::render {

class BodyPass {
 public:
  static constexpr int levels = 3;  // of detail: level k cuts each edge of the mesh into 2^k parts

  explicit BodyPass(const std::filesystem::path& shaders);

  /// See Renderer::add_mesh().
  MeshHandle add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count);
  /// Throws std::invalid_argument if a draw does not fit its mesh or the vertices of the frame.
  void check(const FrameData& frame) const;

  /// Uploads a frame that passes check(), seen from `eye`. An object 1 m large at a distance of 1 m covers
  /// `pixels_at_one_metre`. `occlusion` must be updated for this frame. `frame` must live until all is drawn.
  void update(const FrameData& frame, const AmbientOcclusion& occlusion, const glm::vec3& eye,
              float pixels_at_one_metre);
  void draw_shadows(const glm::mat4& light_clip_from_world);
  void draw(const FrameData& frame);
  /// Draws the translucent sets that hide what is behind them, or the others, after all solids. Sets that stand behind
  /// the bodies require stencil_bodies where a body is seen; the other sets set it.
  void draw_translucent(bool hiding);

 private:
  void check(const MeshDraw& draw, const FrameData& frame) const;

  struct Instance {
    std::uint32_t first_vertex;
    float radius;
    OccluderRange occluders;
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
    std::array<std::unique_ptr<Level>, levels> level;  // each is built at its first use
  };
  using Batches = std::map<std::pair<std::uint32_t, int>, std::vector<Instance>,
                           std::greater<>>;  // by mesh and level, finest first

  void build_batches(const FrameData& frame, const AmbientOcclusion& occlusion, const glm::vec3& eye,
                     float pixels_at_one_metre);
  void draw_batches(const Batches& batches, bool coarsest);
  const Level& level_of_detail(Mesh& mesh, int level) const;

  Program program_, marked_program_, shadow_program_;
  std::vector<Mesh> meshes_;
  Batches batches_;
  std::vector<std::pair<const TranslucentSet*, Batches>> translucent_;  // sets of the current frame
  std::vector<std::pair<float, std::uint32_t>> distances_;              // from the eye, with the index of the body
  Buffer instances_;
  TableTexture positions_, normals_, marks_, occluders_;
};

}  // namespace engine::render
