#include "app/ui/panel/panel.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

namespace app::ui {
namespace {

void draw_tour_button(Widgets& w, Session& session, UiState& ui, float width) {
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  const bool pressed = ImGui::Button("Tour", {width, 0});
  ImGui::PopStyleColor(3);
  w.register_item("Tour", "Five steps show how the method works, on this very frame (G).");
  if (pressed) ui.tour.toggle(session, ui.overlays);
}

void draw_scene(Widgets& w, Session& session, UiState& ui) {
  const softbody::Scene& scene = session.world().scene();
  const std::filesystem::path from = session.simulation.loaded.file.name();
  const std::string shown = from.has_parent_path() ? from.filename().string() : scene.name;
  w.row_label("Scene", w.px(62));
  const float help_width = ImGui::GetFrameHeight(), tour_button_width = w.px(52),
              gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - help_width - tour_button_width - 2 * gap);
  if (w.begin_combo("Scene", shown.c_str(), scene.look_at.c_str())) {
    std::string chosen;
    for (const session::SceneChoice& choice : session.scenes.choices()) {
      if (w.combo_item(choice.name.c_str(), choice.key == session.simulation.loaded.file.name(),
                       choice.look_at.c_str()))
        chosen = choice.key;
    }
    ImGui::EndCombo();
    if (!chosen.empty()) session.scenes.choose(chosen);
  }
  ImGui::SameLine(0, gap);
  draw_tour_button(w, session, ui, tour_button_width);
  ImGui::SameLine(0, gap);
  if (w.button("?", "What this shows, keys and mouse (F1).", help_width)) ui.help = !ui.help;
}

void draw_time_controls(Widgets& w, Session& session) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 4 * gap) / 5;
  const char* pause = session.simulation.clock.paused ? "Go on###Pause" : "Pause###Pause";
  if (w.button(pause, "Stops the world; the panel and the overlays stay alive (Space).", width)) {
    session.simulation.clock.paused = !session.simulation.clock.paused;
  }
  ImGui::SameLine();
  if (w.button("Step", "One frame of 1/60 s, then pause (N).", width)) session.simulation.clock.single_step();
  ImGui::SameLine();
  if (w.button("Reset", "The scene from its start, with the settings below and without added bodies (R).", width))
    session.simulation.reset();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session.simulation.can_undo());
  if (w.button("Undo",
               "Brings the world back that was there before the last reset, choice of scene, drop, throw, import, "
               "deletion, or drag of a body or solid (Ctrl+Z).",
               width))
    session.simulation.undo();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session.simulation.can_redo());
  if (w.button("Redo", "Brings back what the last undo took away (Ctrl+Y).", width)) session.simulation.redo();
  ImGui::EndDisabled();

  w.checkbox("Slow motion", session.simulation.clock.slow_motion, "The world runs slower than real time (S).");
  ImGui::SameLine(w.px(label_column + 20));
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::BeginDisabled(!session.simulation.clock.slow_motion);
  float percent = static_cast<float>(session.simulation.clock.slow_factor * 100);
  if (w.slider("Slow motion speed", percent, 100 * static_cast<float>(session::SimulationClock::min_slow_factor),
               100 * static_cast<float>(session::SimulationClock::max_slow_factor), "%.0f %% of real time",
               "How fast slow motion runs.", true)) {
    session.simulation.clock.slow_factor = static_cast<double>(percent) / 100;
  }
  ImGui::EndDisabled();
}

void draw_progress(Widgets& w, const Session& session) {
  const softbody::World& world = session.world();
  ImGui::TextDisabled("Frame %d", world.frame());
  ImGui::SameLine(w.px(label_column));
  ImGui::TextDisabled("%.2f s", world.last_step().time);
  ImGui::SameLine(w.px(label_column + 64));
  std::string right = std::to_string(world.bodies().count()) + (world.bodies().count() == 1 ? " body" : " bodies");
  const bool slow = session.simulation.clock.pace() < 0.95;
  const std::size_t to_come = bodies_to_come(world);
  if (session.simulation.clock.paused) {
    right = "paused";
  } else if (slow) {
    right = "slowed to " + std::to_string(static_cast<int>(session.simulation.clock.pace() * 100)) + " %";
  } else if (world.all_at_rest()) {
    right += ", all at rest";
  }
  if (to_come > 0 && (!slow || session.simulation.clock.paused)) right += ", " + std::to_string(to_come) + " to come";
  w.right_text(right);
  w.register_item(
      "Progress",
      slow ? "The machine does not keep up, or frames take more substeps than there may be: the world runs slower than "
             "asked for, and no time is made up for."
           : "Simulated frames and time; bodies in the world, and those that the scene brings later.");
}

void draw_overlays(Widgets& w, Session& session, UiState& ui) {
  const auto next_cell = [&](std::size_t i) {
    if (i % 2) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.54f);
  };
  std::size_t i = 0;
  for (const render::OverlayRow& row : render::overlay_table) {
    next_cell(i++);
    const std::string tooltip = std::string(row.tooltip) + " (" + row.shortcut + ")";
    w.checkbox(std::string(row.label).c_str(), ui.overlays.*row.shown, tooltip.c_str());
  }
  next_cell(i++);
  w.checkbox("Hash table", ui.hash_table, "The hash table itself, one square a bucket (T).");
  next_cell(i++);
  w.checkbox("Error vs run time###Error against run time", ui.sweep,
             "All methods over all their settings on one frozen frame, as a plot: what each costs, and misses (E).");
  next_cell(i++);
  w.checkbox("Compare methods", session.comparison.choice.on,
             "All methods on the same frozen frame: what each costs, and what it misses (V).");
}

void draw_plan(Widgets& w, const softbody::World& world) {
  for (const softbody::Stage stage : world.plan().stages) {
    const std::string key(softbody::stage_key(stage));
    ImGui::BulletText("%s", key.c_str());
  }
  for (const auto& [stage, why] : world.plan().left_out) {
    const std::string key(softbody::stage_key(stage));
    ImGui::TextDisabled("without %s: %s", key.c_str(), why.c_str());
    w.register_item(key.c_str(), why.c_str());
  }
}

}  // namespace

std::size_t bodies_to_come(const softbody::World& world) {
  // A step brings the bodies of the frame before it; the first ones are there at once.
  const auto comes = [&](const softbody::BodySource& body) { return body.appear >= std::max(world.frame(), 1); };
  return static_cast<std::size_t>(std::ranges::count_if(world.scene().bodies, comes));
}

void draw_panel(Widgets& w, Session& session, UiState& ui, const ScreenRect& area, bool opaque) {
  // The contents keep their width when a scrollbar appears, so that folding a section moves nothing sideways.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SetNextWindowContentSize({w.px(panel_width) - 2 * style.WindowPadding.x - style.ScrollbarSize, 0});
  begin_dock("Panel", area, opaque);
  draw_scene(w, session, ui);
  draw_time_controls(w, session);
  draw_progress(w, session);
  draw_bodies(w, session, ui);
  ImGui::Spacing();
  if (w.section("Detection", true))
    draw_detection(w, session, ui.hash_table || ui.tour.open() || ui.overlays.boxes || ui.overlays.cells);
  if (w.section("Show", true)) draw_overlays(w, session, ui);
  if (w.section("World", false)) draw_world(w, session, ui);
  if (w.section("Numbers", true)) draw_numbers(w, session, ui.render_scale);
  if (w.section("Stability", false)) draw_stability(w, session);
  if (w.section("Files", false)) draw_files(w, session, ui);
  if (w.section("Take away", false)) draw_take_away(w, session, ui);
  if (w.section("Stages of a step", false)) draw_plan(w, session.world());
  end_dock();
}

}  // namespace app::ui
