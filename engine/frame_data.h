#pragma once
// Everything that one picture shows, as plain data. Lengths in metres, widths in pixels, colours sRGB in 0..1.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

namespace engine {

/// A list of triangles given to Renderer::add_mesh once; any number of bodies share it.
struct MeshHandle {
  std::uint32_t index = 0;
};

/// One deforming body: `mesh` laid over the vertices from `first_vertex` on, in the order of its indices.
struct MeshDraw {
  MeshHandle mesh;
  std::uint32_t first_vertex = 0, vertex_count = 0;
  glm::vec3 colour{0.8f};
};

/// Bodies that one looks through, all of one opacity. They cast no shadow.
struct TranslucentSet {
  std::vector<MeshDraw> meshes;
  float opacity = 0.4f;
  bool hides = true;  // what is behind them, other ones of the set and overlays, as if they were solid
  float recess = 0;   // radii: what is so little before a solid is seen as behind it
};

struct Sphere {
  glm::vec3 centre{0.0f};
  float radius = 1.0f;
  glm::vec3 colour{0.62f};
};

/// All points within `radius` of a line segment.
struct Capsule {
  glm::vec3 from{0.0f}, to{0.0f};
  float radius = 1.0f;
  glm::vec3 colour{0.62f};
};

/// A box in any direction.
struct Block {
  glm::vec3 centre{0.0f};
  glm::mat3 half_axes{1.0f};  // columns: from the centre to the middles of three faces, m
  glm::vec3 colour{0.62f};
};

/// A square of an unbounded plane round the scene, with the floor's look; from behind one looks through it.
struct Plane {
  glm::vec3 point{0.0f};
  glm::vec3 normal{0.0f, 1.0f, 0.0f};  // of length 1
};

struct Line {
  glm::vec3 a, b;
  glm::vec4 colour;
};

struct Point {
  glm::vec3 position;
  glm::vec4 colour;
};

struct Box {
  glm::vec3 lo, hi;
  glm::vec4 colour;
};

// Overlays. `hidden` is how much of the alpha is left where something solid is in front: 0 hides, 1 shows through.
struct LineSet {
  std::vector<Line> lines;
  float width = 1.5f;
  float hidden = 0.2f;
};

struct PointSet {
  std::vector<Point> points;
  float diameter = 6.0f;
  float hidden = 0.2f;
};

struct BoxSet {
  std::vector<Box> boxes;
  float width = 1.25f;
  float hidden = 0.2f;
  float fill = 0.06f;  // alpha of the faces, times that of the box; 0: edges alone
};

struct FrameData {
  // Bodies. `positions` and `normals` (length 1) have equal lengths and must live until draw() returns.
  std::span<const glm::vec3> positions, normals;
  std::vector<MeshDraw> meshes;
  std::vector<TranslucentSet> translucent;  // in this order, over all that is solid

  std::vector<Sphere> spheres;
  std::vector<Capsule> capsules;
  std::vector<Block> blocks;
  std::vector<Plane> planes;
  std::optional<float> ground;  // height of the floor, m; without one there is no floor

  std::vector<LineSet> lines;
  std::vector<PointSet> points;
  std::vector<BoxSet> boxes;

  // A sphere round all that casts shadows. Keep it still from frame to frame: the shadows' resolution follows it.
  glm::vec3 bounds_centre{0.0f};
  float bounds_radius = 5.0f;

  float pixel_scale = 1.0f;  // multiplies widths and diameters: 2 on a high-density screen
  bool rounded = true;  // draw bodies with smooth outlines, bulging the triangles; false: the triangles as they are
};

/// Normals of length 1 for one body, weighted by area; (0, 1, 0) where no triangle is. `normals` is overwritten.
void smooth_normals(std::span<const std::uint32_t> triangles, std::span<const glm::vec3> positions,
                    std::span<glm::vec3> normals);

}  // namespace engine
