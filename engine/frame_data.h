#pragma once
// All that one picture shows, as plain data. Lengths in metres, widths in pixels, colours as sRGB in 0..1.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

namespace engine {

/// Names a triangle mesh that Renderer::add_mesh() uploaded. Any number of bodies can share it.
struct MeshHandle {
  std::uint32_t index = 0;
};

/// One deforming body: `mesh` with the positions and normals from `first_vertex` on.
struct MeshDraw {
  MeshHandle mesh;
  std::uint32_t first_vertex = 0, vertex_count = 0;
  glm::vec3 colour{0.8f};
};

/// Translucent bodies of one opacity. They cast no shadow. Each pixel shows only the nearest surface of a set, which
/// hides the sets that are drawn later and are behind it.
struct TranslucentSet {
  std::vector<MeshDraw> meshes;
  float opacity = 0.4f;
  bool hides = true;  // overlays behind them; false: a veil, drawn after the overlays and sets that hide
  // Bodies, though not other solids, hide them even where these are farther away: solid bodies, and earlier sets
  // without this flag.
  bool behind_bodies = false;
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

struct OrientedBox {
  glm::vec3 centre{0.0f};
  glm::mat3 half_axes{1.0f};  // columns, at right angles: from the centre to the middles of three faces, m
  glm::vec3 colour{0.62f};
};

/// An unbounded plane that looks like the floor. Only a square near the scene is drawn, and only its front.
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

/// An axis-aligned box.
struct Box {
  glm::vec3 lo, hi;
  glm::vec4 colour;
};

// Overlays. Where a solid is in front of them, their alpha is multiplied by `occluded_alpha` (0: hidden, 1: unchanged).
struct LineSet {
  std::vector<Line> lines;
  float width = 1.5f;
  float occluded_alpha = 0.2f;
};

struct PointSet {
  std::vector<Point> points;
  float diameter = 6.0f;
  float occluded_alpha = 0.2f;
};

struct BoxSet {
  std::vector<Box> boxes;
  float width = 1.25f;          // of the edges
  float occluded_alpha = 0.2f;  // of the edges; faces behind a solid are hidden
  float face_alpha = 0.06f;     // multiplies the alpha of the box for its faces; 0: edges only
};

struct FrameData {
  // Bodies. `positions` and `normals` (of length 1) have equal sizes and must live until draw() returns.
  std::span<const glm::vec3> positions, normals;
  // Marks regions on solid bodies: a region is where the value, interpolated between the vertices, is above one half.
  // One value for each position, or empty.
  std::vector<float> marks;
  glm::vec3 mark_colour{0.0f};
  std::vector<MeshDraw> meshes;
  std::vector<TranslucentSet> translucent;  // drawn in this order after all solids: those that hide, then the others

  std::vector<Sphere> spheres;
  std::vector<Capsule> capsules;
  std::vector<OrientedBox> oriented_boxes;
  std::vector<Plane> planes;
  std::optional<float> floor_height;  // m; empty: no floor

  std::vector<LineSet> lines;
  std::vector<PointSet> points;
  std::vector<BoxSet> boxes;

  // A sphere round all that casts shadows. Change it rarely: shadows flicker when their resolution changes.
  glm::vec3 bounds_centre{0.0f};
  float bounds_radius = 5.0f;  // > 0

  float pixel_scale = 1.0f;  // multiplies widths and diameters: 2 on a high-density screen
  bool tessellated = true;   // draw bodies with round outlines (Phong tessellation); false: with flat triangles
};

/// Computes the vertex normals of one body (length 1): the means of its triangles' normals, weighted by area. A vertex
/// without area gets (0, 1, 0). `positions` and `normals` have equal sizes; `triangles` holds three indices < that size
/// per triangle.
void smooth_normals(std::span<const std::uint32_t> triangles, std::span<const glm::vec3> positions,
                    std::span<glm::vec3> normals);

}  // namespace engine
