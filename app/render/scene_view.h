#pragma once
// Draws a world: bodies, solids, and the overlays over them. The window and the captures share it.

#include <filesystem>
#include <map>
#include <optional>

#include "app/compare/drawn_positions.h"
#include "app/compare/table_contents.h"
#include "app/compare/true_surfaces.h"
#include "app/render/highlight.h"
#include "app/render/overlays.h"
#include "engine/renderer.h"
#include "softbody/world.h"

namespace app {

/// What to draw over the bodies. Pointers may be null; they and the spans must live until draw() returns.
struct OverlayRequest {
  Overlays shown;
  const collide::DebugGeometry* debug = nullptr;  // for boxes, cells and the bucket
  const BucketContents* bucket = nullptr;         // its entries and cells stand out, and show in any case ...
  std::optional<Cell> bucket_cell;                // ... those of this cell apart from others
  std::optional<softbody::BodyId> selected_body;  // its outline shows
  std::vector<collide::DebugGeometry::Box> areas;
  const std::vector<collide::Contact>* missed = nullptr;  // vertices of the world as it is
  std::span<const softbody::SurfaceTouch> touches;        // the same
  std::span<const SurfaceMark> marks;                     // the same
  const Highlight* highlight = nullptr;                   // shows, and all else steps back
  const softbody::World* ghost = nullptr;                 // another world with the same bodies, to look through
  DrawnPositions ghost_positions;
};

class SceneView {
 public:
  static constexpr std::size_t most_boxes = 20'000;  // of each kind; further ones are not drawn
  static constexpr float full_strain = 0.2f;         // relative change of length at the ends of the colour scale

  /// Needs a current context. Throws engine::ShaderError.
  explicit SceneView(const std::filesystem::path& shaders) : renderer_(shaders) {}

  void draw(const softbody::World& world, const OverlayRequest& overlays, const engine::Camera& camera,
            const engine::Viewport& viewport, float pixel_scale, const DrawnPositions& positions);
  /// Every vertex where it is.
  void draw(const softbody::World& world, const OverlayRequest& overlays, const engine::Camera& camera,
            const engine::Viewport& viewport, float pixel_scale) {
    draw(world, overlays, camera, viewport, pixel_scale, DrawnPositions{.now = world.positions()});
  }

  /// What the last draw() drew, from elsewhere. The world is not asked, but labels and hints stay those of then.
  void draw_again(const engine::Camera& camera, const engine::Viewport& viewport, float pixel_scale) {
    frame_.pixel_scale = pixel_scale;
    renderer_.draw(camera, viewport, frame_);
  }

  /// The scene's own camera, with limits that suit its size.
  engine::Camera camera(const softbody::Scene& scene, glm::ivec2 size);
  /// The other way round: the view that a scene must have for such a camera, to a tenth of a millimetre or degree.
  static softbody::View view(const engine::Camera& camera, glm::ivec2 size);
  /// The camera steps back or closer, so that a picture of another size holds as much.
  static void refit(engine::Camera& camera, glm::ivec2 from, glm::ivec2 to);

 private:
  struct Bounds {
    glm::vec3 centre;
    float radius;
  };
  struct UploadedMesh {
    engine::MeshHandle handle;
    std::vector<std::uint32_t> indices;
  };

  void gather_positions(const DrawnPositions& positions);
  /// How to draw the bodies whose vertices, gathered last, begin at `first`; their colours are still to be set.
  std::vector<engine::MeshDraw> gather_bodies(const softbody::World& world, std::uint32_t first);
  void gather_ghost(const softbody::World& ghost, const DrawnPositions& positions);
  void apply(const Highlight& highlight);
  void gather_solids(const softbody::Scene& scene);
  const UploadedMesh& upload(const softbody::Mesh& mesh);
  Bounds bounds(const softbody::Scene& scene);
  double radius(const softbody::MeshSource& source);

  engine::Renderer renderer_;
  // By contents: worlds come and go, but their meshes are few and mostly the same.
  std::map<std::vector<softbody::Triangle>, UploadedMesh> meshes_;
  std::vector<std::pair<softbody::MeshSource, double>> radii_;  // m, of meshes seen so far
  std::vector<glm::vec3> positions_, normals_;
  engine::FrameData frame_;
};

}  // namespace app
