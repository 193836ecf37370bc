#include "app/ui/tour/highlights.h"

#include <algorithm>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/base/text.h"
#include "app/render/overlay_shapes.h"
#include "app/render/palette.h"
#include "app/ui/views/bucket_view.h"

namespace app::ui {
namespace {

constexpr glm::vec3 outline_colour{0.13f, 0.16f, 0.20f};

glm::vec3 vertex(const TourContext& v, collide::Index i) {
  const collide::Frame f = v.world.positions();
  return {f.x[i], f.y[i], f.z[i]};
}

void frame_camera(render::Highlight& highlight, const glm::vec3& lo, const glm::vec3& hi) {
  highlight.centre = 0.5f * (lo + hi);
  highlight.radius = std::max(0.5f * glm::distance(lo, hi), 1e-3f);
}

void frame_camera_on_pair(const TourContext& v, render::Highlight& highlight) {
  frame_camera(highlight, glm::min(v.f.bounds[0].lo, v.f.bounds[1].lo), glm::max(v.f.bounds[0].hi, v.f.bounds[1].hi));
}

engine::BoxSet outlines(float width, float fill) {
  return {.boxes = {}, .width = width, .occluded_alpha = 0.7f, .face_alpha = fill};
}

engine::Box add_cell(const TourContext& v, const compare::Cell& cell, const glm::vec3& colour,
                     render::Highlight& highlight) {
  engine::BoxSet set = outlines(1.25f, 0.06f);
  set.boxes.push_back(render::cell_box(cell, v.world.collision().cell_size, glm::vec4(colour, 0.8f)));
  highlight.boxes.push_back(set);
  return set.boxes.front();
}

void add_contacts(const TourContext& v, const std::vector<collide::Contact>& contacts, const glm::vec3& colour,
                  float width, render::Highlight& highlight) {
  engine::LineSet lines{.lines = {}, .width = width, .occluded_alpha = 0.9f};
  engine::PointSet points{.points = {}, .diameter = 3 + 1.5f * width, .occluded_alpha = 0.9f};
  for (const collide::Contact& contact : contacts) {
    const glm::vec3 a = vertex(v, contact.a), b = vertex(v, contact.b);
    lines.lines.push_back({a, b, glm::vec4(colour, 1.0f)});
    points.points.push_back({a, glm::vec4(colour, 1.0f)});
    points.points.push_back({b, glm::vec4(colour, 1.0f)});
  }
  highlight.lines.push_back(std::move(lines));
  highlight.points.push_back(std::move(points));
}

/// Adds the face between the cells of the two corners, or the skipped cell.
void add_barrier(const TourContext& v, const Miss& miss, render::Highlight& highlight) {
  const glm::vec3& size = v.world.collision().cell_size;
  const glm::vec4 colour(render::cell_face_colour, 1.0f);
  engine::BoxSet set = outlines(2.5f, 0.3f);
  if (miss.face) {
    const engine::Box one = render::cell_box(miss.corners[0].cell, size, colour);
    const engine::Box other = render::cell_box(miss.corners[1].cell, size, colour);
    engine::Box face{glm::min(one.lo, other.lo), glm::max(one.hi, other.hi), colour};
    face.lo[miss.face->axis] = face.hi[miss.face->axis] = static_cast<float>(miss.face->index) * size[miss.face->axis];
    set.boxes.push_back(face);
  } else {
    set.boxes.push_back(render::cell_box(*miss.skipped, size, colour));
  }
  highlight.boxes.push_back(std::move(set));
}

}  // namespace

void highlight_body(const TourContext& v, render::Highlight& highlight) {
  const auto& [lo, hi] = v.f.bounds[0];
  highlight.bodies = {v.f.body};
  engine::BoxSet box = outlines(2.5f, 0.08f);
  box.boxes.push_back({lo, hi, glm::vec4(outline_colour, 1.0f)});
  highlight.boxes = {std::move(box)};
  highlight.points = {{.points = {{lo, glm::vec4(outline_colour, 1.0f)}, {hi, glm::vec4(outline_colour, 1.0f)}},
                       .diameter = 9,
                       .occluded_alpha = 0.9f}};
  highlight.labels = {{lo, "minimum"}, {hi, "maximum"}};
  frame_camera(highlight, lo, hi);
}

void highlight_boxes(const TourContext& v, render::Highlight& highlight) {
  highlight.bodies = {v.f.body};
  highlight.opacity = 0.45f;
  engine::BoxSet boxes = outlines(2, 0.12f);
  for (collide::Index i = v.f.boxes.begin; i < v.f.boxes.end; ++i) {
    const auto& [lo, hi, body] = v.f.structure.boxes[i];
    const std::uint32_t bucket = v.f.structure.box_bucket[v.f.structure.box_first[i]];
    boxes.boxes.push_back({lo, hi, glm::vec4(render::bucket_colour(bucket), 1.0f)});
  }
  highlight.boxes = {std::move(boxes)};
  frame_camera(highlight, v.f.bounds[0].lo, v.f.bounds[0].hi);
}

void highlight_corners(const TourContext& v, render::Highlight& highlight) {
  highlight.bodies = {v.f.body};
  highlight.opacity = 0.35f;
  const auto& [lo, hi, body] = v.f.structure.boxes[v.f.box];
  engine::BoxSet box = outlines(2.5f, 0.15f);
  box.boxes.push_back({lo, hi, glm::vec4(outline_colour, 1.0f)});
  highlight.boxes = {std::move(box)};
  add_cell(v, v.hashed_corner().cell, render::same_cell_colour, highlight);
  engine::PointSet points{.points = {}, .diameter = 9, .occluded_alpha = 0.9f};
  for (std::size_t i = 0; i < v.f.corners.size(); ++i) {
    const HashedCorner& corner = v.f.corners[i];
    const bool chosen = &corner == &v.hashed_corner();
    points.points.push_back({corner.at, glm::vec4(chosen ? render::same_cell_colour : outline_colour, 1.0f)});
    std::string text = std::to_string(i + 1);
    if (chosen) text.append(": bucket ").append(grouped(corner.bucket));
    highlight.labels.push_back({corner.at, std::move(text)});
  }
  highlight.points = {std::move(points)};
  frame_camera(highlight, v.f.bounds[0].lo, v.f.bounds[0].hi);
}

void highlight_bucket(const TourContext& v, render::Highlight& highlight) {
  highlight.opacity = 0.35f;
  const HashedCorner& corner = v.bucket_corner();
  const compare::BucketContents bucket = v.f.table.bucket(corner.bucket);
  const compare::CellGroup* own = bucket.group(corner.cell);
  engine::BoxSet boxes = outlines(2.5f, 0.2f);
  glm::vec3 low = corner.at, high = corner.at;
  for (const compare::CellGroup& group : bucket.groups) {
    const glm::vec3 colour = &group == own ? render::same_cell_colour : render::aliased_colour;
    const engine::Box cell = add_cell(v, group.cell, colour * 0.7f, highlight);
    highlight.labels.push_back({0.5f * (cell.lo + cell.hi), "cell " + cell_text(group.cell)});
    for (const collide::Index item : group.items) {
      const auto& [lo, hi, body] = v.f.structure.boxes[item];
      boxes.boxes.push_back({lo, hi, glm::vec4(colour, 1.0f)});
      highlight.bodies.push_back(body);
      low = glm::min(low, lo);
      high = glm::max(high, hi);
    }
  }
  std::ranges::sort(highlight.bodies);
  highlight.bodies.erase(std::unique(highlight.bodies.begin(), highlight.bodies.end()), highlight.bodies.end());
  highlight.boxes.push_back(std::move(boxes));
  frame_camera(highlight, low, high);
}

void highlight_contact(const TourContext& v, render::Highlight& highlight) {
  highlight.bodies = {v.f.body};
  if (v.f.other != v.f.body) highlight.bodies.push_back(v.f.other);
  highlight.opacity = 0.35f;
  const glm::vec3 colour = v.f.other == v.f.body ? render::contact_inside_colour : render::contact_between_colour;
  add_contacts(v, v.f.contacts, colour, 2, highlight);
  add_contacts(v, v.f.missed, render::contact_missed_colour, 3, highlight);
  if (v.f.closest) {
    add_contacts(v, {*v.f.closest}, render::hand_colour, 3.5f, highlight);
    highlight.labels = {
        {0.5f * (vertex(v, v.f.closest->a) + vertex(v, v.f.closest->b)), fmt::format("d = {:.3f} m", v.f.distance)}};
  }
  frame_camera_on_pair(v, highlight);
}

void highlight_miss(const TourContext& v, render::Highlight& highlight) {
  if (!v.f.miss) return highlight_contact(v, highlight);
  const Miss& miss = *v.f.miss;
  highlight.bodies = {miss.bodies[0]};
  if (miss.bodies[1] != miss.bodies[0]) highlight.bodies.push_back(miss.bodies[1]);
  highlight.opacity = 0.35f;
  highlight.bodies_hide = false;
  engine::BoxSet boxes = outlines(2.5f, 0.2f);
  glm::vec3 low = miss.at[0], high = low;
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::vec3 colour = render::body_colour(v.world.body(miss.bodies[i]).number) * 0.72f;
    const auto& [lo, hi, body] = v.f.structure.boxes[miss.boxes[i]];
    boxes.boxes.push_back({lo, hi, glm::vec4(colour, 1.0f)});
    const engine::Box cell = add_cell(v, miss.corners[i].cell, colour, highlight);
    low = glm::min(low, glm::min(lo, cell.lo));
    high = glm::max(high, glm::max(hi, cell.hi));
    highlight.points.push_back(
        {.points = {{miss.corners[i].at, glm::vec4(colour, 1.0f)}}, .diameter = 9, .occluded_alpha = 0.9f});
    const glm::vec3 middle = 0.5f * (cell.lo + cell.hi);
    highlight.labels.push_back(
        {{middle.x, cell.hi.y, middle.z}, fmt::format("bucket {}", grouped(miss.corners[i].bucket))});
  }
  highlight.boxes.push_back(std::move(boxes));
  add_barrier(v, miss, highlight);
  add_contacts(v, v.f.missed, render::contact_missed_colour, 2, highlight);  // those of the same pair, if known
  add_contacts(v, {miss.contact}, render::contact_missed_colour, 3.5f, highlight);
  highlight.labels.push_back({0.5f * (miss.at[0] + miss.at[1]),
                              fmt::format("{:.3f} m", glm::distance(miss.at[0], miss.at[1])),
                              render::contact_missed_colour});
  frame_camera(highlight, low, high);
}

}  // namespace app::ui
