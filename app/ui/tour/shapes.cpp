#include "app/ui/tour/shapes.h"

#include <algorithm>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/base/text.h"
#include "app/render/overlay_shapes.h"
#include "app/render/palette.h"

namespace app {
namespace {

constexpr glm::vec3 shape_ink{0.13f, 0.16f, 0.20f};

glm::vec3 vertex(const TourView& v, collide::Index i) {
  const collide::Frame f = v.world.positions();
  return {f.x[i], f.y[i], f.z[i]};
}

void frame(Spotlight& light, const glm::vec3& lo, const glm::vec3& hi) {
  light.centre = 0.5f * (lo + hi);
  light.radius = std::max(0.5f * glm::distance(lo, hi), 1e-3f);
}

void frame_pair(const TourView& v, Spotlight& light) {
  frame(light, glm::min(v.f.bounds[0].lo, v.f.bounds[1].lo), glm::max(v.f.bounds[0].hi, v.f.bounds[1].hi));
}

engine::BoxSet outlines(float width, float fill) { return {.boxes = {}, .width = width, .hidden = 0.7f, .fill = fill}; }

void add_cell(const TourView& v, const Cell& cell, const glm::vec3& colour, Spotlight& light) {
  engine::BoxSet set = outlines(1.25f, 0.06f);
  set.boxes.push_back(cell_box(cell, v.world.collision().cell_size, glm::vec4(colour, 0.8f)));
  light.boxes.push_back(std::move(set));
}

void add_contacts(const TourView& v, const std::vector<collide::Contact>& contacts, const glm::vec3& colour,
                  float width, Spotlight& light) {
  engine::LineSet lines{.lines = {}, .width = width, .hidden = 0.9f};
  engine::PointSet points{.points = {}, .diameter = 3 + 1.5f * width, .hidden = 0.9f};
  for (const collide::Contact& contact : contacts) {
    const glm::vec3 a = vertex(v, contact.a), b = vertex(v, contact.b);
    lines.lines.push_back({a, b, glm::vec4(colour, 1.0f)});
    points.points.push_back({a, glm::vec4(colour, 1.0f)});
    points.points.push_back({b, glm::vec4(colour, 1.0f)});
  }
  light.lines.push_back(std::move(lines));
  light.points.push_back(std::move(points));
}

}  // namespace

void show_body(const TourView& v, Spotlight& light) {
  const auto& [lo, hi] = v.f.bounds[0];
  light.bodies = {v.f.body};
  engine::BoxSet box = outlines(2.5f, 0.08f);
  box.boxes.push_back({lo, hi, glm::vec4(shape_ink, 1.0f)});
  light.boxes = {std::move(box)};
  light.points = {
      {.points = {{lo, glm::vec4(shape_ink, 1.0f)}, {hi, glm::vec4(shape_ink, 1.0f)}}, .diameter = 9, .hidden = 0.9f}};
  light.labels = {{lo, "minimum"}, {hi, "maximum"}};
  frame(light, lo, hi);
}

void show_boxes(const TourView& v, Spotlight& light) {
  light.bodies = {v.f.body};
  light.opacity = 0.45f;
  engine::BoxSet boxes = outlines(2, 0.12f);
  for (const collide::Index i : v.f.boxes) {
    const auto& [lo, hi, body] = v.f.structure.boxes[i];
    const std::uint32_t bucket = v.f.structure.box_bucket[v.f.structure.box_first[i]];
    boxes.boxes.push_back({lo, hi, glm::vec4(bucket_colour(bucket), 1.0f)});
  }
  light.boxes = {std::move(boxes)};
  frame(light, v.f.bounds[0].lo, v.f.bounds[0].hi);
}

void show_corners(const TourView& v, Spotlight& light) {
  light.bodies = {v.f.body};
  light.opacity = 0.35f;
  const auto& [lo, hi, body] = v.f.structure.boxes[v.f.box];
  engine::BoxSet box = outlines(2.5f, 0.15f);
  box.boxes.push_back({lo, hi, glm::vec4(shape_ink, 1.0f)});
  light.boxes = {std::move(box)};
  add_cell(v, v.chosen().cell, same_cell_colour, light);
  engine::PointSet points{.points = {}, .diameter = 9, .hidden = 0.9f};
  for (std::size_t i = 0; i < v.f.corners.size(); ++i) {
    const HashedCorner& corner = v.f.corners[i];
    const bool chosen = i == v.corner;
    points.points.push_back({corner.at, glm::vec4(chosen ? same_cell_colour : shape_ink, 1.0f)});
    std::string text = std::to_string(i + 1);
    if (chosen) text.append(": bucket ").append(grouped(corner.bucket));
    light.labels.push_back({corner.at, std::move(text)});
  }
  light.points = {std::move(points)};
  frame(light, v.f.bounds[0].lo, v.f.bounds[0].hi);
}

void show_bucket(const TourView& v, Spotlight& light) {
  light.opacity = 0.35f;
  const BucketContents bucket = v.f.table.bucket(v.chosen().bucket);
  const CellGroup* own = bucket.group(v.chosen().cell);
  engine::BoxSet boxes = outlines(2.5f, 0.2f);
  glm::vec3 low = v.f.bounds[0].lo, high = v.f.bounds[0].hi;
  for (const CellGroup& group : bucket.groups) {
    const glm::vec3 colour = &group == own ? same_cell_colour : aliased_colour;
    add_cell(v, group.cell, colour * 0.7f, light);
    for (const collide::Index item : group.items) {
      const auto& [lo, hi, body] = v.f.structure.boxes[item];
      boxes.boxes.push_back({lo, hi, glm::vec4(colour, 1.0f)});
      light.bodies.push_back(body);
      low = glm::min(low, lo);
      high = glm::max(high, hi);
    }
  }
  std::ranges::sort(light.bodies);
  light.bodies.erase(std::unique(light.bodies.begin(), light.bodies.end()), light.bodies.end());
  light.boxes.push_back(std::move(boxes));
  frame(light, low, high);
}

void show_contact(const TourView& v, Spotlight& light) {
  light.bodies = {v.f.body};
  if (v.f.other != v.f.body) light.bodies.push_back(v.f.other);
  light.opacity = 0.35f;
  const glm::vec3 colour = v.f.other == v.f.body ? contact_inside_colour : contact_between_colour;
  add_contacts(v, v.f.contacts, colour, 2, light);
  if (v.f.missed) add_contacts(v, *v.f.missed, contact_missed_colour, 3, light);
  if (v.f.closest) {
    add_contacts(v, {*v.f.closest}, hand_colour, 3.5f, light);
    light.labels = {
        {0.5f * (vertex(v, v.f.closest->a) + vertex(v, v.f.closest->b)), fmt::format("d = {:.3f} m", v.f.distance)}};
  }
  frame_pair(v, light);
}

}  // namespace app
