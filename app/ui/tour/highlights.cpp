// What each step of the guided tour highlights in the scene.

#include <algorithm>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/base/text.h"
#include "app/render/overlays.h"
#include "app/render/palette.h"
#include "app/ui/tour/steps.h"

namespace app::ui {
namespace {

constexpr glm::vec3 outline_colour{0.13f, 0.16f, 0.20f};

void frame_camera(render::Highlight& highlight, const collide::Aabb& region) {
  highlight.centre = 0.5f * (region.lo + region.hi);
  highlight.radius = std::max(0.5f * glm::distance(region.lo, region.hi), 1e-3f);
}

engine::BoxSet outlines(float width, float fill, std::vector<engine::Box> boxes = {}) {
  return {.boxes = std::move(boxes), .width = width, .occluded_alpha = 0.7f, .face_alpha = fill};
}

/// Returns the part of a box that is in or near the region that the camera frames. A cell may be far larger.
engine::Box clip(engine::Box box, const collide::Aabb& framed) {
  const float margin = 0.25f * glm::distance(framed.lo, framed.hi);
  box.lo = glm::max(box.lo, framed.lo - margin);
  box.hi = glm::min(box.hi, framed.hi + margin);
  return box;
}

/// Adds what is near the framed region of a cell to the set, and returns it.
engine::Box add_cell(const TourContext& v, const compare::Cell& cell, const glm::vec3& colour,
                     const collide::Aabb& framed, engine::BoxSet& set) {
  return set.boxes.emplace_back(
      clip(render::cell_box(cell, *v.world.collision().cell_size, glm::vec4(colour, 0.8f)), framed));
}

engine::BoxSet cell_outlines() { return outlines(1.25f, 0.06f); }

void add_contacts(const TourContext& v, const std::vector<collide::Contact>& contacts, const glm::vec3& colour,
                  float width, render::Highlight& highlight) {
  engine::LineSet& lines =
      highlight.lines.emplace_back(engine::LineSet{.lines = {}, .width = width, .occluded_alpha = 0.9f});
  engine::PointSet& points = highlight.points.emplace_back(
      engine::PointSet{.points = {}, .diameter = 3 + 1.5f * width, .occluded_alpha = 0.9f});
  const collide::Frame frame = v.world.positions();
  for (const collide::Contact& contact : contacts) {
    const glm::vec3 a = position(frame, contact.a), b = position(frame, contact.b);
    lines.lines.push_back({a, b, glm::vec4(colour, 1.0f)});
    points.points.push_back({a, glm::vec4(colour, 1.0f)});
    points.points.push_back({b, glm::vec4(colour, 1.0f)});
  }
}

/// Adds the face between the cells of the two corners, or the skipped cell.
void add_barrier(const TourContext& v, const ExplainedMiss& miss, const collide::Aabb& framed,
                 render::Highlight& highlight) {
  const glm::vec3& size = *v.world.collision().cell_size;
  const glm::vec4 colour(render::cell_colour, 1.0f);
  engine::Box barrier;
  if (miss.face) {
    const engine::Box one = render::cell_box(miss.corners[0].cell, size, colour);
    const engine::Box other = render::cell_box(miss.corners[1].cell, size, colour);
    barrier = {glm::min(one.lo, other.lo), glm::max(one.hi, other.hi), colour};
    const auto [axis, index] = *miss.face;
    barrier.lo[axis] = barrier.hi[axis] = static_cast<float>(index) * size[axis];
  } else {
    barrier = render::cell_box(*miss.skipped, size, colour);
  }
  highlight.boxes.push_back(outlines(2.5f, 0.3f, {clip(barrier, framed)}));
}

}  // namespace

void highlight_body(const TourContext& v, render::Highlight& highlight) {
  const auto& [lo, hi] = v.f.bounds[0];
  highlight.bodies = {v.f.body};
  const glm::vec4 colour(outline_colour, 1.0f);
  highlight.boxes = {outlines(2.5f, 0.08f, {{lo, hi, colour}})};
  highlight.points = {{.points = {{lo, colour}, {hi, colour}}, .diameter = 9, .occluded_alpha = 0.9f}};
  highlight.labels = {{lo, "minimum"}, {hi, "maximum"}};
  frame_camera(highlight, v.f.bounds[0]);
}

void highlight_boxes(const TourContext& v, render::Highlight& highlight) {
  highlight.bodies = {v.f.body};
  highlight.opacity = 0.45f;
  engine::BoxSet& boxes = highlight.boxes.emplace_back(outlines(2, 0.12f));
  for (collide::Index i = v.f.boxes.begin; i < v.f.boxes.end; ++i) {
    const auto& [lo, hi, body] = v.f.structure.boxes[i];
    const std::uint32_t bucket = v.f.structure.box_bucket[v.f.structure.box_first[i]];
    boxes.boxes.push_back({lo, hi, glm::vec4(render::bucket_colour(bucket), 1.0f)});
  }
  frame_camera(highlight, v.f.bounds[0]);
}

void highlight_corners(const TourContext& v, render::Highlight& highlight) {
  highlight.bodies = {v.f.body};
  highlight.opacity = 0.35f;
  const auto& [lo, hi, body] = v.f.structure.boxes[v.f.box];
  engine::BoxSet cell = cell_outlines();
  add_cell(v, v.hashed_corner().cell, render::same_cell_colour, v.f.bounds[0], cell);
  highlight.boxes = {outlines(2.5f, 0.15f, {{lo, hi, glm::vec4(outline_colour, 1.0f)}}), std::move(cell)};
  engine::PointSet& points =
      highlight.points.emplace_back(engine::PointSet{.points = {}, .diameter = 9, .occluded_alpha = 0.9f});
  for (std::size_t i = 0; i < v.f.corners.size(); ++i) {
    const HashedCorner& corner = v.f.corners[i];
    const bool chosen = &corner == &v.hashed_corner();
    points.points.push_back({corner.at, glm::vec4(chosen ? render::same_cell_colour : outline_colour, 1.0f)});
    std::string text = std::to_string(i + 1);
    if (chosen) text.append(": bucket ").append(grouped(corner.bucket));
    highlight.labels.push_back({corner.at, std::move(text)});
  }
  frame_camera(highlight, v.f.bounds[0]);
}

void highlight_bucket(const TourContext& v, render::Highlight& highlight) {
  highlight.opacity = 0.35f;
  const compare::BucketContents bucket = v.bucket();
  const auto groups = TourContext::shown_cells(bucket);
  engine::BoxSet boxes = outlines(2.5f, 0.2f), cells = cell_outlines();
  collide::Aabb framed{v.bucket_corner().at, v.bucket_corner().at};
  const auto colour_of = [&](const compare::CellGroup& group) {
    return &group == &groups.front() ? render::same_cell_colour : render::aliased_colour;
  };
  for (const compare::CellGroup& group : groups)
    for (const collide::Index item : group.items) {
      const auto& [lo, hi, body] = v.f.structure.boxes[item];
      boxes.boxes.push_back({lo, hi, glm::vec4(colour_of(group), 1.0f)});
      highlight.bodies.insert(body);
      framed = collide::joint(framed, {lo, hi});
    }
  for (const compare::CellGroup& group : groups) {
    const engine::Box cell = add_cell(v, group.cell, colour_of(group) * 0.7f, framed, cells);
    highlight.labels.push_back({0.5f * (cell.lo + cell.hi), "cell " + compare::cell_text(group.cell)});
  }
  highlight.boxes = {std::move(cells), std::move(boxes)};
  frame_camera(highlight, framed);
}

void highlight_contact(const TourContext& v, render::Highlight& highlight) {
  highlight.bodies = {v.f.body, v.f.other};
  highlight.opacity = 0.35f;
  const glm::vec3 colour = v.f.other == v.f.body ? render::contact_inside_colour : render::contact_between_colour;
  add_contacts(v, v.f.contacts, colour, 2, highlight);
  add_contacts(v, v.f.missed, render::contact_missed_colour, 3, highlight);
  if (v.f.closest) {
    add_contacts(v, {*v.f.closest}, render::hand_colour, 3.5f, highlight);
    const collide::Frame frame = v.world.positions();
    highlight.labels = {{0.5f * (position(frame, v.f.closest->a) + position(frame, v.f.closest->b)),
                         fmt::format("d = {:.3f} m", v.f.distance)}};
  }
  frame_camera(highlight, collide::joint(v.f.bounds[0], v.f.bounds[1]));
}

void highlight_miss(const TourContext& v, render::Highlight& highlight) {
  if (!v.f.miss) return highlight_contact(v, highlight);
  const ExplainedMiss& miss = *v.f.miss;
  highlight.bodies = {miss.bodies[0], miss.bodies[1]};
  highlight.opacity = 0.35f;
  highlight.bodies_hide = false;
  collide::Aabb framed{glm::min(miss.at[0], miss.at[1]), glm::max(miss.at[0], miss.at[1])};
  for (const collide::Index box : miss.boxes)
    framed = collide::joint(framed, {v.f.structure.boxes[box].lo, v.f.structure.boxes[box].hi});
  engine::BoxSet boxes = outlines(2.5f, 0.2f), cells = cell_outlines();
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::vec3 colour = render::body_colour(v.world.body(miss.bodies[i]).number) * 0.72f;
    const auto& [lo, hi, body] = v.f.structure.boxes[miss.boxes[i]];
    boxes.boxes.push_back({lo, hi, glm::vec4(colour, 1.0f)});
    const engine::Box cell = add_cell(v, miss.corners[i].cell, colour, framed, cells);
    highlight.points.push_back(
        {.points = {{miss.corners[i].at, glm::vec4(colour, 1.0f)}}, .diameter = 9, .occluded_alpha = 0.9f});
    const glm::vec3 middle = 0.5f * (cell.lo + cell.hi);
    highlight.labels.push_back(
        {{middle.x, cell.hi.y, middle.z}, fmt::format("bucket {}", grouped(miss.corners[i].bucket))});
  }
  highlight.boxes = {std::move(cells), std::move(boxes)};
  add_barrier(v, miss, framed, highlight);
  add_contacts(v, v.f.missed, render::contact_missed_colour, 2, highlight);  // those of the same pair, if known
  add_contacts(v, {miss.contact}, render::contact_missed_colour, 3.5f, highlight);
  highlight.labels.push_back({0.5f * (miss.at[0] + miss.at[1]),
                              fmt::format("{:.3f} m", glm::distance(miss.at[0], miss.at[1])),
                              render::contact_missed_colour});
  frame_camera(highlight, framed);
}

}  // namespace app::ui
