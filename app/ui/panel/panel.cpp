#include "app/ui/panel/panel.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include <fmt/core.h>

namespace app::ui {
namespace {

void draw_tour_button(Widgets& w, float width) {
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  const bool pressed = ImGui::Button("Tour", {width, 0});
  ImGui::PopStyleColor(3);
  w.register_item("Tour", "Explains the method step by step on this frame (G).");
  if (pressed) w.ask([](Session& s, UiState& ui) { ui.tour.toggle(s, ui.overlays); });
}

void draw_scene(Widgets& w, const Session& session) {
  const softbody::Scene& scene = session.world().scene();
  const std::filesystem::path from = session.simulation.loaded.file.name();
  const std::string shown = from.has_parent_path() ? from.filename().string() : scene.name;
  w.row_label("Scene", w.px(62));
  const float help_width = ImGui::GetFrameHeight(), tour_button_width = w.px(52),
              gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - help_width - tour_button_width - 2 * gap);
  if (w.begin_combo("Scene", shown, scene.look_at)) {
    for (const session::SceneChoice& choice : session.scenes.choices())
      if (w.combo_item(choice.name, choice.key == session.simulation.loaded.file.name(), choice.look_at))
        w.ask([&choice](Session& s) { s.scenes.choose(choice.key); });
    ImGui::EndCombo();
  }
  ImGui::SameLine(0, gap);
  draw_tour_button(w, tour_button_width);
  ImGui::SameLine(0, gap);
  if (w.button("?", "Shows the help: keys and mouse (F1).", help_width)) w.ask([](UiState& ui) { ui.help = !ui.help; });
}

void draw_time_controls(Widgets& w, const Session& session) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  if (w.button("Reset", "Restarts the scene with the present settings and without added bodies (R).", width))
    w.ask([](Session& s) { s.simulation.reset(); });
  ImGui::SameLine();
  if (w.button("Undo", "Undoes the last reset, choice of scene, change of bodies, or drag of a solid (Ctrl+Z).", width,
               session.simulation.can_undo()))
    w.ask([](Session& s) { s.simulation.undo(); });
  ImGui::SameLine();
  if (w.button("Redo", "Brings back what the last undo took away (Ctrl+Y).", width, session.simulation.can_redo()))
    w.ask([](Session& s) { s.simulation.redo(); });

  if (w.checkbox("Slow motion", session.simulation.clock.slow_motion, "Runs the simulation slower than real time (S)."))
    w.ask([](Session& s) { s.simulation.clock.slow_motion = !s.simulation.clock.slow_motion; });
  ImGui::SameLine(w.px(label_column + 20));
  ImGui::SetNextItemWidth(-FLT_MIN);
  const Disabled off(!session.simulation.clock.slow_motion);
  double percent = 100 * session.simulation.clock.slow_factor;
  if (w.slider("Slow motion speed", percent, 100 * session::SimulationClock::min_slow_factor,
               100 * session::SimulationClock::max_slow_factor, "%.0f %% of real time", "The speed of slow motion.",
               true))
    w.ask([factor = percent / 100](Session& s) { s.simulation.clock.slow_factor = factor; });
}

void draw_overlays(Widgets& w, const Session& session, const UiState& ui) {
  std::size_t i = 0;
  const auto flag = [&](std::string_view label, bool shown, std::string_view tooltip, const auto& change) {
    if (i++ % 2) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.54f);
    if (w.checkbox(label, shown, tooltip)) w.ask(change);
  };
  for (const render::OverlayRow& row : render::overlay_table)
    if (!row.needs_solver || session.simulated())
      flag(row.label, ui.overlays.*row.shown, fmt::format("{} ({})", row.tooltip, row.shortcut),
           [&row](UiState& state) { state.overlays.*row.shown = !(state.overlays.*row.shown); });
  if (session.simulated())
    flag("Beside", session.simulation.beside(),
         "Simulates a second world beside this one, with other settings: what they cost and what they miss (A).",
         [](Session& s) { s.simulation.toggle_beside(); });
  flag("Hash table", ui.hash_table, "Shows the hash table: each square is a bucket (T).",
       [](Session& s, UiState& state) { state.toggle_hash_table(s); });
  flag("Error vs run time###Error against run time", ui.lower == LowerView::sweep,
       "Plots error against run time of the shown methods with many settings, on one frame (E).",
       [](UiState& state) { state.toggle(LowerView::sweep); });
  flag("Compare methods", ui.lower == LowerView::comparison,
       "Shows the cost and the misses of methods side by side, on the same frame (V).",
       [](UiState& state) { state.toggle(LowerView::comparison); });
  flag("Paper vs exact###Story", ui.story, "Counts and marks what the paper's method misses, and says why (W).",
       [](UiState& state) { state.set_story(!state.story); });
  flag("Status lights", ui.lights, "What to expect of the method and of the time step (L).",
       [](UiState& state) { state.lights = !state.lights; });
}

void draw_plan(Widgets& w, const Session& session, const UiState&) {
  const softbody::World& world = *session.simulated();
  const std::vector<softbody::Stage> as_forces = world.plan().unprojected(world.integrator_choice().integrator());
  for (const softbody::Stage stage : world.plan().stages) {
    std::string key(softbody::stage_key(stage));
    if (stage == softbody::Stage::solids)
      for (const softbody::ShapeTraits* shape : world.plan().shapes)
        key.append(shape == world.plan().shapes.front() ? ": " : ", ").append(shape->name);
    const bool as_force = std::ranges::find(as_forces, stage) != as_forces.end();
    ImGui::BulletText(as_force ? "%s, as a force" : "%s", key.c_str());
    if (as_force) w.register_item(key, "XPBD moves no particles to where it has them.");
  }
  for (const auto& [stage, why] : world.plan().left_out) {
    const std::string key(softbody::stage_key(stage));
    ImGui::TextDisabled("without %s: %s", key.c_str(), why.c_str());
    w.register_item(key, why);
  }
}

struct Section {
  const char* label;
  bool open_at_first, needs_solver;
  void (*draw)(Widgets& w, const Session& session, const UiState& ui);
};
constexpr std::array<Section, 8> sections{{
    {"Detection", true, false, draw_detection},
    {"Show", true, false, draw_overlays},
    {"World", false, true, draw_world},
    {"Numbers", true, false, draw_numbers},
    {"Stability", false, true, draw_stability},
    {"Files", false, false, draw_files},
    {"Export", false, false, draw_export},
    {"Stages of a step", false, true, draw_plan},
}};

/// Draws the sections of the panel. Without a solver it leaves out those that need one, and says so.
void draw_sections(Widgets& w, const Session& session, const UiState& ui) {
  std::string left_out;
  for (const Section& section : sections) {
    if (section.needs_solver && !session.simulated())
      left_out.append(left_out.empty() ? "" : ", ").append(section.label);
    else if (w.section(section.label, section.open_at_first))
      section.draw(w, session, ui);
  }
  if (left_out.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("without %s: %s", left_out.c_str(), no_solver_text);
  ImGui::PopStyleColor();
  w.register_item("Left out", "What needs a solver is left out, and so are the keys for it. Open a scene to have it.");
}

}  // namespace

void draw_panel(Widgets& w, const Session& session, const UiState& ui, const ScreenRect& area, bool opaque) {
  // The contents keep their width when a scrollbar appears, so that folding a section moves nothing sideways.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SetNextWindowContentSize({w.px(panel_width) - 2 * style.WindowPadding.x - style.ScrollbarSize, 0});
  begin_dock("Panel", area, opaque);
  draw_scene(w, session);
  draw_time_controls(w, session);
  draw_bodies(w, session);
  ImGui::Spacing();
  draw_sections(w, session, ui);
  ImGui::End();
}

}  // namespace app::ui
