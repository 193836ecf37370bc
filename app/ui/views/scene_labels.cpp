#include "app/ui/views/scene_labels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace app::ui {
namespace {

constexpr float ring_radius = 15, ring_width = 2.5f, leader_width = 1.5f, halo_width = 3;  // design pixels

bool contains(const ScreenRect& outer, const ScreenRect& inner) {
  return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.max.x <= outer.max.x &&
         inner.max.y <= outer.max.y;
}

/// Returns the square in the ring, half as large as the ring's area, so that texts may be at its corners.
ScreenRect square_in_ring(const LabelOnScreen& label) {
  const float half = 0.7f * label.ring;
  return {{label.point.x - half, label.point.y - half}, {label.point.x + half, label.point.y + half}};
}

/// Returns a free place for a text. It tries above the point to the right, then the other three corners, then further
/// up and down.
std::optional<ScreenRect> place_beside(const LabelOnScreen& label, const ScreenRect& area,
                                       std::span<const ScreenRect> taken, float scale) {
  const auto text_at = [&](bool right, bool above, int rows) {
    const ScreenRect inside = square_in_ring(label);
    const float gap = 2 * scale + static_cast<float>(rows) * (label.size.y + scale);
    const float x = std::floor(right ? inside.max.x + 5 * scale : inside.min.x - 5 * scale - label.size.x);
    const float y = std::floor(above ? inside.min.y - gap - label.size.y : inside.max.y + gap);
    return ScreenRect{{x, y}, {x + label.size.x, y + label.size.y}};
  };
  const auto is_free = [&](const ScreenRect& text) {
    return contains(area, text) && std::ranges::none_of(taken, [&](const ScreenRect& t) { return overlap(t, text); });
  };
  for (int rows = 0; rows < 3; ++rows)
    for (const auto& [right, above] : {std::pair{true, true}, {false, true}, {true, false}, {false, false}})
      if (const ScreenRect text = text_at(right, above, rows); is_free(text)) return text;
  return std::nullopt;
}

/// Draws a line from the ring to its text.
void draw_leader(ImDrawList& draw, const LabelOnScreen& label, const ScreenRect& text, ImU32 colour, float width) {
  const glm::vec2 from(label.point.x, label.point.y);
  const glm::vec2 to = glm::clamp(from, glm::vec2(text.min.x, text.min.y), glm::vec2(text.max.x, text.max.y));
  const float distance = glm::distance(from, to);
  if (distance <= label.ring) return;
  const glm::vec2 rim = from + (to - from) * (label.ring / distance);
  draw.AddLine({rim.x, rim.y}, {to.x, to.y}, colour, width);
}

}  // namespace

std::vector<std::optional<ScreenRect>> place_texts(std::span<const LabelOnScreen> labels, const ScreenRect& area,
                                                   float scale) {
  std::vector<ScreenRect> taken;
  for (const LabelOnScreen& label : labels)
    if (label.ring > 0) taken.push_back(square_in_ring(label));
  std::vector<std::optional<ScreenRect>> places;
  for (const LabelOnScreen& label : labels) {
    places.push_back(place_beside(label, area, taken, scale));
    if (places.back()) taken.push_back(*places.back());
  }
  return places;
}

void draw_labels(std::span<const render::SceneLabel> labels, const engine::Camera& camera, glm::ivec2 size,
                 const ScreenRect& area, float scale) {
  const glm::vec2 ratio = glm::vec2(area.max.x - area.min.x, area.max.y - area.min.y) / glm::vec2(glm::max(size, 1));
  const ImVec2 pad{4 * scale, 1 * scale};
  std::vector<LabelOnScreen> on_screen;
  std::vector<const render::SceneLabel*> seen;
  for (const render::SceneLabel& label : labels) {
    const auto pixel = camera.project(label.at, size);
    if (!pixel) continue;
    const ImVec2 text = ImGui::CalcTextSize(label.text.c_str());
    on_screen.push_back({.point = {area.min.x + pixel->x * ratio.x, area.min.y + pixel->y * ratio.y},
                         .size = {text.x + 2 * pad.x, text.y + 2 * pad.y},
                         .ring = label.ring ? ring_radius * scale : 0});
    seen.push_back(&label);
  }
  const auto places = place_texts(on_screen, area, scale);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect(area.min, area.max);
  for (const bool halo : {true, false})
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i]->ring) continue;
      const ImU32 colour = halo ? to_imgui(glm::vec3(1.0f), 0.9f) : to_imgui(*seen[i]->ring);
      const float wider = halo ? halo_width : 0;
      draw->AddCircle(on_screen[i].point, on_screen[i].ring, colour, 0, (ring_width + wider) * scale);
      if (places[i]) draw_leader(*draw, on_screen[i], *places[i], colour, (leader_width + wider) * scale);
    }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!places[i]) continue;
    const auto& [min, max] = *places[i];
    draw->AddRectFilled(min, max, to_imgui(glm::vec3(1.0f), 0.85f), 4 * scale);
    draw->AddText({min.x + pad.x, min.y + pad.y}, to_imgui(glm::vec3(0.1f)), seen[i]->text.c_str());
  }
  draw->PopClipRect();
}

}  // namespace app::ui
