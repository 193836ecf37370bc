#include "app/ui/views/views.h"

#include <fmt/core.h>

namespace app::ui {
namespace {

void draw_figure(Widgets& w, const TourFigure& figure) {
  if (figure.colour) w.swatch(*figure.colour);
  w.figure(figure.label, figure.value, figure.tooltip);
}

/// Draws the eight corners to choose from; `shown` is one of context.f.corners, or a corner of another box.
void draw_corners(Widgets& w, const TourContext& context, const HashedCorner& shown) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Corner");
  const float gap = w.px(3), left = w.px(58);
  const float width = (ImGui::GetContentRegionMax().x - left - 7 * gap) / 8;
  for (std::size_t i = 0; i < context.f.corners.size(); ++i) {
    ImGui::SameLine(left + static_cast<float>(i) * (width + gap));
    const bool chosen = &context.f.corners[i] == &shown;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const std::string number = std::to_string(i + 1);
    if (w.button(fmt::format("{}###Corner {}", number, number), "Shows the hash of this corner point of the box.",
                 width))
      w.ask([i](UiState& ui) { ui.tour.choose_corner(i); });
    if (chosen) ImGui::PopStyleColor();
  }
}

void draw_step(Widgets& w, const Tour& tour, const TourContext& context) {
  const TourStep& step = tour_steps()[tour.step()];
  w.wrapped_text("Tour text", step.text(context));
  ImGui::Spacing();
  if (step.corner) draw_corners(w, context, (context.*step.corner)());
  for (const TourFigure& figure : step.figures(context)) draw_figure(w, figure);
  ImGui::Spacing();
  ImGui::TextDisabled("The paper's method on the whole frame (§3)");
  w.register_item("Tour claims", "The work of the paper's method on all bodies, beside the paper's claims.");
  for (const TourFigure& figure : figures_of_frame(context.f.work)) draw_figure(w, figure);
}

/// Says that the frame lacks the goal of the step, and offers to run ahead to it.
void draw_lack(Widgets& w, const Session& session, const Tour& tour) {
  const TourGoal& goal = tour_steps()[tour.step()].goal;
  const bool at_rest = session.world().all_at_rest();
  std::string text(goal.lacking);
  if (at_rest)
    text += " Nothing moves, and no body is still to come.";
  else if (tour.has_given_up(session))
    text += " This did not change in 20 seconds of simulated time.";
  w.wrapped_text("Tour lack", text);
  if (w.button(fmt::format("{}###Run ahead", goal.button),
               "Lets the world run, several frames per picture, and pauses it there. It gives up after 20 seconds of "
               "simulated time.",
               0, !at_rest))
    w.ask([](Session& s, UiState& ui) { ui.tour.run_ahead(s); });
  ImGui::Spacing();
}

/// Draws all that is between the title and the buttons.
void draw_content(Widgets& w, const Session& session, const Tour& tour) {
  const auto context = tour.context(session);
  if (const TourGoal* goal = tour.running_to(session))
    return w.wrapped_text("Tour runs ahead",
                          fmt::format("{} (frame {}).", goal->running, grouped(session.world().frame())));
  if (!context) w.wrapped_text("Tour problem", tour.problem());
  if (!context || !tour_steps()[tour.step()].goal.example_has(context->f)) draw_lack(w, session, tour);
  if (context) draw_step(w, tour, *context);
}

void draw_buttons(Widgets& w, const Tour& tour) {
  const float gap = ImGui::GetStyle().ItemSpacing.x, width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  const bool first = tour.step() == 0, last = tour.step() + 1 == tour_steps().size();
  if (w.button("Back", "The page before (left arrow).", width, !first)) w.ask([](UiState& ui) { ui.tour.back(); });
  ImGui::SameLine();
  if (w.button("Next", "The next page (right arrow).", width, !last)) w.ask([](UiState& ui) { ui.tour.next(); });
  ImGui::SameLine();
  if (w.button("Close###Close tour",
               "Ends the tour (Esc). The world goes on from this frame, unless it was paused before the tour.", width))
    w.ask([](Session& s, UiState& ui) { ui.tour.close(s, ui.overlays); });
}

}  // namespace

void draw_tour(Widgets& w, const Session& session, const Tour& tour, const ScreenRect& area) {
  begin_dock("Tour", area, true, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav);
  const TourStep& step = tour_steps()[tour.step()];
  ImGui::TextDisabled("Tour %zu of %zu", tour.step() + 1, tour_steps().size());
  w.wrapped_text("Tour title", std::string(step.title));
  ImGui::Separator();
  const float buttons = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild(fmt::format("Step {}", tour.step()).c_str(), {0, -buttons});  // each scrolls on its own
  draw_content(w, session, tour);
  ImGui::EndChild();
  ImGui::Spacing();
  draw_buttons(w, tour);
  ImGui::End();
}

}  // namespace app::ui
