#include "app/ui/panel/panel.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include <fmt/core.h>

#include "app/ui/state/shortcuts.h"

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
  const float tour_button_width = w.px(52), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - tour_button_width - gap);
  if (w.begin_combo("Scene", shown, scene.look_at)) {
    for (const session::SceneChoice& choice : session.scenes.choices())
      if (w.combo_item(choice.name, choice.key == session.simulation.loaded.file.name(), choice.look_at))
        w.ask([&choice](Session& s) { s.scenes.choose(choice.key); });
    ImGui::EndCombo();
  }
  ImGui::SameLine(0, gap);
  draw_tour_button(w, tour_button_width);
}

void draw_actions(Widgets& w, const Session& session) {
  const bool has_solver = session.simulated();
  const float buttons = has_solver ? 5 : 3, gap = w.px(4);
  const float width = (ImGui::GetContentRegionAvail().x - (buttons - 1) * gap) / buttons;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, ImGui::GetStyle().ItemSpacing.y});
  const auto button = [&](const char* label, const char* tooltip, bool enabled, const auto& asked) {
    if (w.button(label, tooltip, width, enabled)) w.ask(asked);
    ImGui::SameLine();
  };
  button("Reset", "Restarts the scene with the present settings and without added bodies (R).", true,
         [](Session& s) { s.simulation.reset(); });
  button("Undo", "Undoes the last change of a body, a setting or the scene, or a reset (Ctrl+Z).",
         can_undo(session.simulation), [](Session& s) { undo(s.simulation); });
  button("Redo", "Brings back what the last undo took away (Ctrl+Y).", can_redo(session.simulation),
         [](Session& s) { redo(s.simulation); });
  if (has_solver) {
    button("Drop", "Drops another body from above (D); with Shift, twenty.", session.bodies.can_drop(),
           [](Session& s) { s.bodies.drop(); });
    button("Throw", "Throws a body from the camera, by B to where the mouse points, else to the middle.",
           session.bodies.can_drop(), WindowTask::throw_body);
  }
  ImGui::PopStyleVar();
  ImGui::NewLine();
}

void draw_overlays(Widgets& w, const Session& session, const UiState& ui) {
  std::size_t i = 0;
  for (const render::OverlayRow& row : render::overlay_table) {
    if (row.needs_solver && !session.simulated()) continue;
    if (i++ % 2) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.54f);
    if (w.checkbox(row.label, ui.overlays.*row.shown, fmt::format("{} ({})", row.tooltip, row.shortcut)))
      w.ask([&row](UiState& state) { state.overlays.*row.shown = !(state.overlays.*row.shown); });
  }
}

/// Draws the check boxes of the keys that switch something on and off.
void draw_switches(Widgets& w, const Session& session, const UiState& ui, bool rare) {
  for (const Shortcut& key : shortcuts()) {
    if (!key.is_on || key.rare != rare) continue;
    if (w.checkbox(key.text, key.is_on(session, ui), fmt::format("{} ({})", key.tooltip, key.keys_text)))
      std::visit([&](const auto& act) { w.ask(act); }, key.act);
    ImGui::SameLine();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetStyle().FramePadding.y);
    const Disabled grey(true);
    w.right_text(std::string(key.keys_text));
  }
}

void draw_time_and_view(Widgets& w, const Session& session, const UiState& ui) {
  draw_switches(w, session, ui, true);
  w.row_label("Slow motion", w.px(label_column));
  double percent = 100 * session.simulation.clock.slow_factor;
  if (w.slider("Slow motion speed", percent, 100 * session::SimulationClock::min_slow_factor,
               100 * session::SimulationClock::max_slow_factor, "%.0f %% of real time", "The speed of slow motion.",
               true))
    w.ask([factor = percent / 100](Session& s) { s.simulation.clock.slow_factor = factor; });
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
  bool needs_solver;
  void (*draw)(Widgets& w, const Session& session, const UiState& ui);
};
constexpr std::array<Section, 10> sections{{
    {"Solids", true, draw_solids},
    {"Bodies", false, draw_bodies},
    {"World", true, draw_world},
    {"Numbers", false, draw_numbers},
    {"Stability", true, draw_stability},
    {"Detection", false, draw_detection},
    {"Files", false, draw_files},
    {"Export", false, draw_export},
    {"Time and view", false, draw_time_and_view},
    {"Stages of a step", true, draw_plan},
}};

/// Draws the sections. Without a solver it leaves out those that need one, and says so.
void draw_sections(Widgets& w, const Session& session, const UiState& ui) {
  std::string left_out;
  for (const Section& section : sections) {
    if (section.needs_solver && !session.simulated())
      left_out.append(left_out.empty() ? "" : ", ").append(section.label);
    else if (w.section(section.label))
      section.draw(w, session, ui);
  }
  if (left_out.empty()) return;
  w.pale_text("without " + left_out + ": " + no_solver_text);
  w.register_item("Left out", "What needs a solver is left out, and so are the keys for it. Open a scene to have it.");
}

}  // namespace

void draw_panel(Widgets& w, const Session& session, const UiState& ui, const ScreenRect& area, bool opaque) {
  // The contents keep their width when a scrollbar appears, so that folding a section moves nothing sideways.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SetNextWindowContentSize({w.px(panel_width) - 2 * style.WindowPadding.x - style.ScrollbarSize, 0});
  begin_dock("Panel", area, opaque);
  draw_scene(w, session);
  draw_actions(w, session);
  ImGui::Separator();
  draw_method(w, session);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, w.px(2)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, w.px(4)});
  ImGui::Separator();
  ImGui::TextDisabled("Over the bodies");
  draw_overlays(w, session, ui);
  ImGui::Separator();
  ImGui::TextDisabled("Beside the scene");
  draw_switches(w, session, ui, false);
  ImGui::PopStyleVar(2);
  ImGui::Spacing();
  if (w.section("More")) draw_sections(w, session, ui);
  ImGui::End();
}

}  // namespace app::ui
