#include "app/ui/tour/card.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/render/palette.h"

namespace app {
namespace {

void draw_figure(Widgets& w, const TourFigure& figure) {
  if (figure.colour) {
    w.chip(*figure.colour, ImGui::GetTextLineHeight());
    ImGui::SameLine();
  }
  w.figure(figure.label.c_str(), figure.value, figure.tooltip.c_str());
}

void draw_corners(Widgets& w, Tour& tour, const TourView& view) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Corner");
  const float gap = w.px(3), left = w.px(58);
  const float width = (ImGui::GetContentRegionMax().x - left - 7 * gap) / 8;
  for (std::size_t i = 0; i < view.f.corners.size(); ++i) {
    ImGui::SameLine(left + static_cast<float>(i) * (width + gap));
    const bool chosen = i == view.corner;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const std::string number = std::to_string(i + 1);
    if (w.button(fmt::format("{}###Corner {}", number, number).c_str(),
                 "Shows the hash of this corner point of the box.", width))
      tour.choose_corner(i);
    if (chosen) ImGui::PopStyleColor();
  }
}

void draw_step(Widgets& w, Tour& tour, const TourView& view) {
  const TourStep& step = tour_steps()[tour.step()];
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(step.text.data(), step.text.data() + step.text.size());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  if (step.corners) draw_corners(w, tour, view);
  for (const TourFigure& figure : step.figures(view)) draw_figure(w, figure);
  ImGui::Spacing();
  ImGui::TextDisabled("The paper's method on the whole frame (§3)");
  w.done("Tour claims", "What the step before you belongs to: the work of all bodies, beside what the paper claims.");
  for (const TourFigure& figure : tour_work(view)) draw_figure(w, figure);
}

void draw_buttons(Widgets& w, Session& session, Tour& tour, Overlays& shown) {
  const float gap = ImGui::GetStyle().ItemSpacing.x, width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  const bool first = tour.step() == 0, last = tour.step() + 1 == tour_steps().size();
  ImGui::BeginDisabled(first);
  if (w.button("Back", "The step before (left arrow).", width)) tour.back();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(last);
  if (w.button("Next", "The next step (right arrow).", width)) tour.next();
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (w.button("Close###Close tour", "Ends the tour; the world goes on as before (Esc).", width))
    tour.close(session, shown);
}

}  // namespace

void draw_tour(Widgets& w, Session& session, Tour& tour, Overlays& shown, const SceneArea& area) {
  ImGui::SetNextWindowPos(area.min);
  ImGui::SetNextWindowSize({area.max.x - area.min.x, area.max.y - area.min.y});
  ImGui::SetNextWindowBgAlpha(1);  // nothing is drawn behind it
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin("Tour", nullptr, plate);
  ImGui::PopStyleVar(2);
  const TourStep& step = tour_steps()[tour.step()];
  ImGui::TextDisabled("Tour %zu of %zu", tour.step() + 1, tour_steps().size());
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(step.title.data(), step.title.data() + step.title.size());
  ImGui::PopTextWrapPos();
  ImGui::Separator();
  const float buttons = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("Step", {0, -buttons});
  if (const auto view = tour.view(session)) {
    draw_step(w, tour, *view);
  } else {
    ImGui::TextWrapped("%s", tour.problem().c_str());
    w.done("Tour problem", nullptr);
  }
  if (!session.notice().empty()) ImGui::TextWrapped("%s", session.notice().c_str());
  ImGui::EndChild();
  ImGui::Spacing();
  draw_buttons(w, session, tour, shown);
  ImGui::End();
}

namespace {

bool overlap(const SceneArea& a, const SceneArea& b) {
  return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
}

/// A box for a label beside a point: above it to the right, or in the first other corner, then further up or down,
/// where it lies within the area and on none of those that are there. Where all is full it stays in the first place.
SceneArea place_beside(const ImVec2& point, const ImVec2& size, const SceneArea& area, std::span<const SceneArea> taken,
                       float scale) {
  const auto label_at = [&](bool right, bool above, int rows) {
    const float x = right ? point.x + 5 * scale : point.x - 5 * scale - size.x;
    const float gap = 2 * scale + static_cast<float>(rows) * (size.y + scale);
    const float y = above ? point.y - gap - size.y : point.y + gap;
    return SceneArea{{std::floor(x), std::floor(y)}, {std::floor(x) + size.x, std::floor(y) + size.y}};
  };
  const auto is_free = [&](const SceneArea& box) {
    return box.min.x >= area.min.x && box.min.y >= area.min.y && box.max.x <= area.max.x && box.max.y <= area.max.y &&
           std::ranges::none_of(taken, [&](const SceneArea& t) { return overlap(t, box); });
  };
  for (int rows = 0; rows < 3; ++rows)
    for (const auto& [right, above] : {std::pair{true, true}, {false, true}, {true, false}, {false, false}})
      if (const SceneArea box = label_at(right, above, rows); is_free(box)) return box;
  return label_at(true, true, 0);
}

}  // namespace

void draw_labels(std::span<const SceneLabel> labels, const engine::Camera& camera, glm::ivec2 size,
                 const SceneArea& area, float scale) {
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const glm::vec2 ratio = glm::vec2(area.max.x - area.min.x, area.max.y - area.min.y) / glm::vec2(glm::max(size, 1));
  const ImVec2 pad{4 * scale, 1 * scale};
  std::vector<SceneArea> taken;
  for (const SceneLabel& label : labels) {
    const auto pixel = camera.project(label.at, size);
    if (!pixel) continue;
    const ImVec2 text = ImGui::CalcTextSize(label.text.c_str());
    const SceneArea box = place_beside({area.min.x + pixel->x * ratio.x, area.min.y + pixel->y * ratio.y},
                                       {text.x + 2 * pad.x, text.y + 2 * pad.y}, area, taken, scale);
    taken.push_back(box);
    draw->AddRectFilled(box.min, box.max, to_imgui(glm::vec3(1.0f), 0.85f), 4 * scale);
    draw->AddText({box.min.x + pad.x, box.min.y + pad.y}, to_imgui(glm::vec3(0.1f)), label.text.c_str());
  }
}

}  // namespace app
