#pragma once
// Draws a world: bodies, solids and overlays. The window and the captures share it.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/compare/surface_check.h"
#include "app/compare/table_contents.h"
#include "app/render/highlight.h"
#include "app/render/overlays.h"
#include "app/render/pick.h"
#include "collide/core/workers.h"
#include "engine/render/renderer.h"
#include "softbody/world/measures.h"

namespace app::render {

/// What the user chose to see over the bodies.
struct OverlayChoice {
  Overlays shown;
  std::optional<compare::Cell> bucket_cell;       // what is of this cell has another colour
  std::optional<softbody::BodyId> selected_body;  // its outline is shown
  std::optional<softbody::Grab> grab;             // what the hand holds

  bool operator==(const OverlayChoice&) const = default;
};

/// What to draw over the bodies. Pointers may be null. What they and the spans refer to must live until draw() returns.
struct OverlayRequest : OverlayChoice {
  const collide::DebugGeometry* debug = nullptr;    // for boxes, cells and the bucket
  const compare::BucketContents* bucket = nullptr;  // its entries and cells are shown in any case
  std::vector<collide::DebugGeometry::Box> areas;
  const std::vector<collide::Contact>* missed = nullptr;            // vertices of the present world
  std::optional<collide::Contact> false_found;                      // the same
  std::span<const softbody::SurfaceContactPoint> surface_contacts;  // of the present world
  std::vector<softbody::SolidContactPoint> solid_contacts;          // of the present world
  std::span<const compare::SurfaceMark> marks;                      // of the present world
  const Highlight* highlight = nullptr;                             // everything else is faded
  const softbody::BodiesInMotion* ghost = nullptr;  // another world with the same bodies, drawn translucent
  DrawnPositions ghost_positions;
};

class SceneView {
 public:
  /// threads: prepare a picture. Requires a current context. Throws engine::ShaderError.
  explicit SceneView(const std::filesystem::path& shaders, int threads = 1)
      : SceneView(std::make_shared<engine::render::Renderer>(shaders), threads) {}
  /// Draws with a renderer that others may use, too.
  SceneView(std::shared_ptr<engine::render::Renderer> renderer, int threads)
      : renderer_(std::move(renderer)), workers_(threads) {}

  void draw(const softbody::BodiesInMotion& world, const OverlayRequest& overlays, const engine::Camera& camera,
            const engine::Viewport& viewport, float pixel_scale, const DrawnMeshes& at);
  /// Draws the same data as the last draw() from another camera. The world is not read; labels and fading stay the
  /// same.
  void redraw(const engine::Camera& camera, const engine::Viewport& viewport, float pixel_scale) {
    frame_.pixel_scale = pixel_scale;
    renderer_->draw(camera, viewport, frame_);
  }

  /// Returns the scene's own camera for a picture of this size, with limits of zoom that suit the scene.
  engine::Camera camera(const softbody::BodiesInMotion& world, glm::ivec2 size);
  /// Returns the view that gives a scene this camera: the inverse of camera(), rounded to four decimals.
  static softbody::View view(const engine::Camera& camera, glm::ivec2 size);
  /// Moves the camera so that a picture of another size shows as much.
  static void refit(engine::Camera& camera, glm::ivec2 from, glm::ivec2 to);

 private:
  struct UploadedMesh {
    engine::MeshHandle handle;
    std::vector<std::uint32_t> indices;
  };

  /// Returns the draws of the bodies whose vertices were gathered last and begin at `first`. Colours are not set yet.
  std::vector<engine::MeshDraw> gather_bodies(const softbody::BodiesInMotion& world, std::uint32_t first);
  void gather_ghost(const softbody::BodiesInMotion& ghost, const DrawnPositions& positions);
  void apply(const Highlight& highlight);
  const UploadedMesh& upload(const softbody::Mesh& mesh);
  BoundingSphere bounds(const softbody::BodiesInMotion& world);
  double radius(const softbody::MeshSource& source);

  std::shared_ptr<engine::render::Renderer> renderer_;
  collide::Workers workers_;
  // By content: worlds come and go, but their meshes are few and mostly the same.
  std::map<std::vector<softbody::Triangle>, UploadedMesh> meshes_;
  std::vector<std::pair<softbody::MeshSource, double>> radii_;  // m, of the meshes so far
  std::vector<glm::vec3> positions_, normals_;
  std::vector<glm::vec3> particles_;  // of the simulated meshes
  engine::FrameData frame_;
};

}  // namespace app::render
