#include "app/render/scene_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/render/palette.h"
#include "softbody/model/body_model.h"

namespace app::render {
namespace {

/// Returns a radius that contains all positions, at most 8 times `radius`. It grows in steps of a quarter, so that the
/// shadows' resolution does not flicker while bodies roll away.
float enclosing_radius(const glm::vec3& centre, float radius, std::span<const glm::vec3> positions) {
  float max2 = 0;
  for (const glm::vec3& p : positions) {
    const glm::vec3 d = p - centre;
    const float distance2 = glm::dot(d, d);
    if (std::isfinite(distance2)) max2 = std::max(max2, distance2);
  }
  const float ratio = std::min(std::sqrt(max2) / radius, 8.0f);  // what is farther off casts no shadow
  return ratio <= 1.0f ? radius : radius * std::pow(1.25f, std::ceil(std::log(ratio) / std::log(1.25f)));
}

/// Returns the factor of the camera's distance for pictures of this size. Scenes are composed for wide pictures; in a
/// narrower one the camera stands farther away, so that as much fits in.
double distance_factor(glm::ivec2 size) {
  constexpr double composed_for = 1.5;
  return std::clamp(composed_for * std::max(size.y, 1) / std::max(size.x, 1), 1.0, 3.0);
}

// The pictures of the shapes of solids.
void add(const softbody::SolidSphere& s, engine::FrameData& frame) {
  frame.spheres.push_back({glm::vec3(s.centre), static_cast<float>(s.radius)});
}
void add(const softbody::SolidCapsule& c, engine::FrameData& frame) {
  frame.capsules.push_back({glm::vec3(c.from), glm::vec3(c.to), static_cast<float>(c.radius)});
}
void add(const softbody::SolidBox& b, engine::FrameData& frame) {
  const glm::dmat3 half_axes(b.half_size.x * b.axes[0], b.half_size.y * b.axes[1], b.half_size.z * b.axes[2]);
  frame.oriented_boxes.push_back({glm::vec3(b.centre), glm::mat3(half_axes)});
}
void add(const softbody::SolidPlane& p, engine::FrameData& frame) {
  if (!frame.floor_height && p.normal == glm::dvec3(0, 1, 0))
    frame.floor_height = static_cast<float>(p.point.y);  // a floor
  else
    frame.planes.push_back({glm::vec3(p.point), glm::vec3(p.normal)});
}

void append(const DrawnPositions& from, std::vector<glm::vec3>& to) {
  for (std::size_t i = 0; i < from.size(); ++i) to.push_back(from[i]);
}

void add_solids(const softbody::Scene& scene, engine::FrameData& frame) {
  for (const softbody::Solid& solid : scene.solids)
    if (solid.enabled) std::visit([&](const auto& shape) { add(shape, frame); }, solid.shape);
}

}  // namespace

const SceneView::UploadedMesh& SceneView::upload(const softbody::Mesh& mesh) {
  const auto known = meshes_.find(mesh.triangles);
  if (known != meshes_.end()) return known->second;
  UploadedMesh uploaded;
  for (const softbody::Triangle& t : mesh.triangles)
    uploaded.indices.insert(uploaded.indices.end(), t.begin(), t.end());
  uploaded.handle = renderer_->add_mesh(uploaded.indices, static_cast<std::uint32_t>(mesh.vertices.size()));
  return meshes_.emplace(mesh.triangles, std::move(uploaded)).first->second;
}

std::vector<engine::MeshDraw> SceneView::gather_bodies(const softbody::BodiesInMotion& world, std::uint32_t first) {
  normals_.resize(positions_.size());
  const collide::Bodies& bodies = world.bodies();
  std::vector<engine::MeshDraw> draws;
  std::vector<const UploadedMesh*> meshes;
  const softbody::BodyModel* last = nullptr;
  for (collide::Index b = 0; b < bodies.count(); ++b) {
    const softbody::BodyModel& model = world.model(b);
    meshes.push_back(&model == last ? meshes.back() : &upload(model.shown().mesh));
    last = &model;
    draws.push_back({meshes.back()->handle, first + bodies.first[b], bodies.size(b), {}});
  }
  constexpr double vertex_ns = 20;  // of work
  const int threads = workers_.threads_for(vertex_ns * static_cast<double>(bodies.vertex_count()));
  workers_.share(threads, draws.size(), [&](int, std::size_t b) {
    const std::uint32_t begin = draws[b].first_vertex, count = draws[b].vertex_count;
    engine::smooth_normals(meshes[b]->indices, std::span(positions_).subspan(begin, count),
                           std::span(normals_).subspan(begin, count));
  });
  return draws;
}

void SceneView::gather_ghost(const softbody::BodiesInMotion& ghost, const DrawnPositions& positions) {
  assert(positions.size() == positions_.size());
  const auto first = static_cast<std::uint32_t>(positions_.size());
  append(positions, positions_);
  // A ghost that overlaps its own body stands behind it. Otherwise either surface would show through the other in
  // patches.
  engine::TranslucentSet near{.meshes = {}, .opacity = 0.45f, .behind_bodies = true},
      far{.meshes = {}, .opacity = 0.45f};
  const auto centre = [&](std::uint32_t from, std::uint32_t count) {
    const auto body = std::span(positions_).subspan(from, count);
    return std::accumulate(body.begin(), body.end(), glm::vec3(0.0f)) / static_cast<float>(count);
  };
  std::vector<engine::MeshDraw> draws = gather_bodies(ghost, first);
  for (softbody::BodyId b = 0; b < draws.size(); ++b) {
    const auto radius = static_cast<float>(ghost.model(b).shown().radius);
    const bool overlaps = glm::distance(centre(draws[b].first_vertex - first, draws[b].vertex_count),
                                        centre(draws[b].first_vertex, draws[b].vertex_count)) < 2 * radius;
    draws[b].colour = ghost_colour;
    (overlaps ? near : far).meshes.push_back(draws[b]);
  }
  frame_.translucent.push_back(std::move(near));
  frame_.translucent.push_back(std::move(far));
}

/// Fades bodies that the highlight does not name. These hide no named body, which may be translucent.
void SceneView::apply(const Highlight& highlight) {
  engine::TranslucentSet named{.meshes = {}, .opacity = highlight.opacity, .hides = highlight.bodies_hide},
      others{.meshes = {}, .opacity = 0.15f, .hides = false, .behind_bodies = true};
  std::vector<engine::MeshDraw> solid;
  for (std::size_t b = 0; b < frame_.meshes.size(); ++b) {
    engine::MeshDraw& draw = frame_.meshes[b];
    const bool fades = highlight.fades(static_cast<softbody::BodyId>(b));
    if (fades) draw.colour = glm::mix(draw.colour, glm::vec3(0.75f), 0.7f);
    (fades ? others.meshes : highlight.opacity < 1 ? named.meshes : solid).push_back(draw);
  }
  frame_.meshes = std::move(solid);
  frame_.translucent.push_back(std::move(named));
  frame_.translucent.push_back(std::move(others));
}

void SceneView::draw(const softbody::BodiesInMotion& world, const OverlayRequest& overlays,
                     const engine::Camera& camera, const engine::Viewport& viewport, float pixel_scale,
                     const DrawnMeshes& at) {
  frame_ = {};
  frame_.pixel_scale = pixel_scale;
  // The colours of overlays have meanings, so the bodies are dimmed. What is missed has marks of its own.
  Overlays coloured = overlays.shown;
  coloured.missed = coloured.true_surfaces = false;
  const bool dimmed = coloured.any() || overlays.bucket;
  positions_.clear();
  if (positions_.capacity() > 8 * at.shown.size()) {  // of a world that was left
    positions_ = {};
    normals_ = {};
  }
  append(at.shown, positions_);
  particles_.clear();
  append(at.simulated, particles_);
  frame_.meshes = gather_bodies(world, 0);
  for (softbody::BodyId b = 0; b < frame_.meshes.size(); ++b) {
    const glm::vec3 colour = body_colour(world.body(b).number);
    frame_.meshes[b].colour = dimmed ? glm::mix(colour, glm::vec3(0.86f), 0.6f) : colour;
  }
  const auto vertices = positions_.size();
  if (overlays.ghost) gather_ghost(*overlays.ghost, overlays.ghost_positions);
  frame_.positions = positions_;
  frame_.normals = normals_;
  if (overlays.highlight) apply(*overlays.highlight);
  frame_.tessellated = !overlays.shown.springs;  // springs run along the straight edges

  add_solids(world.scene(), frame_);
  const BoundingSphere around = bounds(world);
  frame_.bounds_centre = around.centre;
  frame_.bounds_radius = enclosing_radius(around.centre, around.radius, positions_);

  const float pixels = 0.5f * static_cast<float>(viewport.size.y) / std::tan(0.5f * camera.fov);
  add_overlays({.world = world,
                .request = overlays,
                .eye = camera.eye(),
                .pixels_at_one_metre = pixels / pixel_scale,
                .shown = std::span(positions_).first(vertices),
                .simulated = particles_},
               frame_);
  if (overlays.highlight) {
    std::ranges::copy(overlays.highlight->boxes, std::back_inserter(frame_.boxes));
    std::ranges::copy(overlays.highlight->lines, std::back_inserter(frame_.lines));
    std::ranges::copy(overlays.highlight->points, std::back_inserter(frame_.points));
  }
  renderer_->draw(camera, viewport, frame_);
}

double SceneView::radius(const softbody::MeshSource& source) {
  const auto known = std::ranges::find(radii_, source, &std::pair<softbody::MeshSource, double>::first);
  if (known != radii_.end()) return known->second;
  return radii_.emplace_back(source, softbody::bounding_radius(source.make())).second;
}

/// Returns a sphere around the solids, and around all frames if that is known, else around the places where bodies
/// start.
BoundingSphere SceneView::bounds(const softbody::BodiesInMotion& world) {
  const softbody::Scene& scene = world.scene();
  const auto known = world.bounds();
  glm::dvec3 lo(known ? glm::dvec3((*known)[0]) : scene.view.target);
  glm::dvec3 hi(known ? glm::dvec3((*known)[1]) : scene.view.target);
  const auto include = [&](const glm::dvec3& centre, double reach) {
    lo = glm::min(lo, centre - reach);
    hi = glm::max(hi, centre + reach);
  };
  engine::FrameData solids;
  add_solids(scene, solids);
  for (const engine::Sphere& s : solids.spheres) include(glm::dvec3(s.centre), double{s.radius});
  for (const engine::OrientedBox& b : solids.oriented_boxes)
    include(glm::dvec3(b.centre), double{glm::length(b.half_axes * glm::vec3(1.0f))});
  for (const engine::Capsule& c : solids.capsules)
    for (const glm::vec3& end : {c.from, c.to}) include(glm::dvec3(end), double{c.radius});
  for (const softbody::BodySource& body : scene.bodies) include(body.position, radius(body.mesh));
  if (scene.dropper) include(scene.dropper->body.position, radius(scene.dropper->body.mesh));
  return {glm::vec3(0.5 * (lo + hi)), static_cast<float>(0.5 * glm::distance(lo, hi)) + (known ? 0.0f : 0.5f)};
}

engine::Camera SceneView::camera(const softbody::BodiesInMotion& world, glm::ivec2 size) {
  const softbody::Scene& scene = world.scene();
  const BoundingSphere around = bounds(world);
  engine::Camera camera;
  camera.fit(around.centre, around.radius, size);  // sets the limits of zoom and depth
  for (const softbody::Solid& solid : scene.solids)
    if (const auto* ground = std::get_if<softbody::Ground>(&solid.shape); ground && solid.enabled)
      camera.set_floor(static_cast<float>(ground->height));
  const softbody::View& view = scene.view;
  camera.set_orbit({glm::vec3(view.target), static_cast<float>(view.distance * distance_factor(size)),
                    static_cast<float>(glm::radians(view.azimuth)), static_cast<float>(glm::radians(view.elevation))});
  return camera;
}

void SceneView::refit(engine::Camera& camera, glm::ivec2 from, glm::ivec2 to) {
  camera.scale_distance(static_cast<float>(distance_factor(to) / distance_factor(from)));
}

softbody::View SceneView::view(const engine::Camera& camera, glm::ivec2 size) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  const engine::Orbit& orbit = camera.orbit();
  softbody::View view;
  for (int k = 0; k < 3; ++k) view.target[k] = rounded(double{orbit.target[k]});
  view.distance = std::max(rounded(double{orbit.distance} / distance_factor(size)), 1e-4);
  view.azimuth = rounded(std::remainder(glm::degrees(double{orbit.azimuth}), 360.0));
  view.elevation = rounded(glm::degrees(double{orbit.elevation}));
  return view;
}

}  // namespace app::render
