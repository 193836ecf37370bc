#include "app/ui/tour/tour_view.h"

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/tour/figures.h"

namespace app::ui {
namespace {

void draw_figure(Widgets& w, const TourFigure& figure) {
  if (figure.colour) {
    w.swatch(*figure.colour, ImGui::GetTextLineHeight());
    ImGui::SameLine();
  }
  w.figure(figure.label.c_str(), figure.value, figure.tooltip.c_str());
}

void draw_corners(Widgets& w, Tour& tour, const TourContext& context) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Corner");
  const float gap = w.px(3), left = w.px(58);
  const float width = (ImGui::GetContentRegionMax().x - left - 7 * gap) / 8;
  for (std::size_t i = 0; i < context.f.corners.size(); ++i) {
    ImGui::SameLine(left + static_cast<float>(i) * (width + gap));
    const bool chosen = i == context.corner;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const std::string number = std::to_string(i + 1);
    if (w.button(fmt::format("{}###Corner {}", number, number).c_str(),
                 "Shows the hash of this corner point of the box.", width))
      tour.choose_corner(i);
    if (chosen) ImGui::PopStyleColor();
  }
}

void draw_step(Widgets& w, Tour& tour, const TourContext& context) {
  const TourStep& step = tour_steps()[tour.step()];
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(step.text.data(), step.text.data() + step.text.size());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  if (step.corners) draw_corners(w, tour, context);
  for (const TourFigure& figure : step.figures(context)) draw_figure(w, figure);
  ImGui::Spacing();
  ImGui::TextDisabled("The paper's method on the whole frame (§3)");
  w.register_item("Tour claims",
                  "What the step before you belongs to: the work of all bodies, beside what the paper claims.");
  for (const TourFigure& figure : figures_of_frame(context)) draw_figure(w, figure);
}

void draw_buttons(Widgets& w, Session& session, Tour& tour, render::Overlays& shown) {
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

void draw_tour(Widgets& w, Session& session, Tour& tour, render::Overlays& shown, const ScreenRect& area) {
  ImGui::SetNextWindowPos(area.min);
  ImGui::SetNextWindowSize({area.max.x - area.min.x, area.max.y - area.min.y});
  ImGui::SetNextWindowBgAlpha(1);  // nothing is drawn behind it
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin("Tour", nullptr, frameless_window);
  ImGui::PopStyleVar(2);
  const TourStep& step = tour_steps()[tour.step()];
  ImGui::TextDisabled("Tour %zu of %zu", tour.step() + 1, tour_steps().size());
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(step.title.data(), step.title.data() + step.title.size());
  ImGui::PopTextWrapPos();
  ImGui::Separator();
  const float buttons = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("Step", {0, -buttons});
  if (const auto context = tour.context(session)) {
    draw_step(w, tour, *context);
  } else {
    ImGui::TextWrapped("%s", tour.problem().c_str());
    w.register_item("Tour problem", nullptr);
  }
  if (!session.simulation.notice.text().empty()) ImGui::TextWrapped("%s", session.simulation.notice.text().c_str());
  ImGui::EndChild();
  ImGui::Spacing();
  draw_buttons(w, session, tour, shown);
  ImGui::End();
}

}  // namespace app::ui
