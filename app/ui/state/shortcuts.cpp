#include "app/ui/state/shortcuts.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/session/system_files.h"

namespace app::ui {
namespace {

void change_levels(Session& session, int by) {
  session.simulation.change_scene("Level", [by](softbody::Scene& scene) {
    scene.collision.levels = std::clamp(scene.collision.levels + by, 0, collide::max_levels);
  });
}

/// Says what an action did, unless it failed.
void tell(Session& session, std::string text) {
  if (!session.simulation.notice.is_error()) session.simulation.notice.tell(std::move(text));
}

void next_method(Session& session) {
  session.settings.next_method(session.comparison.choice.methods);
  tell(session, "Method: " + edited(session.simulation).method().name);
}

void next_contact_surface(Session& session) {
  session.settings.next_contact_surface();
  for (const softbody::ContactSurfaceInfo& info : softbody::contact_surfaces)
    if (info.value == edited(session.simulation).scene().contact_surface)
      tell(session, "Contact: " + std::string(info.name));
}

constexpr std::string_view redo_text = "Redo it (also Ctrl+Shift+Z)";

constexpr std::array shortcut_table{
    Shortcut{GLFW_KEY_SPACE, 0, "Space", "Pause or resume",
             [](Session& s, UiState&) { s.simulation.clock.paused = !s.simulation.clock.paused; }},
    Shortcut{GLFW_KEY_N, GLFW_KEY_PERIOD, "N or .", "Single step",
             [](Session& s, UiState&) { s.simulation.clock.single_step(); }, true},
    Shortcut{GLFW_KEY_S, 0, "S", "Slow motion",
             [](Session& s, UiState&) { s.simulation.clock.slow_motion = !s.simulation.clock.slow_motion; }, false, 0,
             false, [](const Session& s, const UiState&) { return s.simulation.clock.slow_motion; },
             "Runs the simulation slower than real time.", true},
    Shortcut{GLFW_KEY_R, 0, "R", "Reset the scene", [](Session& s, UiState&) { s.simulation.reset(); }},
    Shortcut{GLFW_KEY_Z, 0, "", redo_text, [](Session& s, UiState&) { redo(s.simulation); }, false,
             GLFW_MOD_CONTROL | GLFW_MOD_SHIFT},
    Shortcut{GLFW_KEY_Z, 0, "Ctrl+Z", "Undo the last change", [](Session& s, UiState&) { undo(s.simulation); }, false,
             GLFW_MOD_CONTROL},
    Shortcut{GLFW_KEY_Y, 0, "Ctrl+Y", redo_text, [](Session& s, UiState&) { redo(s.simulation); }, false,
             GLFW_MOD_CONTROL},
    Shortcut{GLFW_KEY_D, 0, "Shift+D", "Drop twenty bodies",
             [](Session& s, UiState&) { s.bodies.drop(session::BodyControls::many_drops); }, false, GLFW_MOD_SHIFT,
             true},
    Shortcut{GLFW_KEY_D, 0, "D", "Drop a body", [](Session& s, UiState&) { s.bodies.drop(); }, false, 0, true},
    Shortcut{GLFW_KEY_B, 0, "B", "Throw a body at the mouse", WindowTask::throw_body, false, 0, true},
    Shortcut{GLFW_KEY_K, 0, "K", "Hold or let go its vertex at the mouse", WindowTask::switch_hold, false, 0, true},
    Shortcut{GLFW_KEY_DELETE, GLFW_KEY_BACKSPACE, "Del", "Delete the selected body",
             [](Session& s, UiState&) { s.bodies.remove_selected(); }, false, 0, true},
    Shortcut{GLFW_KEY_M, 0, "M", "Next shown method", [](Session& s, UiState&) { next_method(s); }},
    Shortcut{GLFW_KEY_F, 0, "F", "Next contact surface", [](Session& s, UiState&) { next_contact_surface(s); }, false,
             0, true},
    Shortcut{GLFW_KEY_LEFT_BRACKET, 0, "[", "Fewer boxes per body", [](Session& s, UiState&) { change_levels(s, -1); },
             true},
    Shortcut{GLFW_KEY_RIGHT_BRACKET, 0, "]", "More boxes per body", [](Session& s, UiState&) { change_levels(s, 1); },
             true},
    Shortcut{GLFW_KEY_G, 0, "G", "Guided tour of the method",
             [](Session& s, UiState& ui) {
               ui.clean = false;
               ui.tour.toggle(s, ui.overlays);
             }},
    Shortcut{GLFW_KEY_LEFT, 0, "Left", "Tour: previous page", [](Session&, UiState& ui) { ui.tour.back(); }},
    Shortcut{GLFW_KEY_RIGHT, 0, "Right", "Tour: next page", [](Session&, UiState& ui) { ui.tour.next(); }},
    Shortcut{GLFW_KEY_A, 0, "A", "A second world beside it", [](Session& s, UiState&) { toggle_beside(s.simulation); },
             false, 0, true, [](const Session& s, const UiState&) { return s.simulation.beside() != nullptr; },
             "Simulates a second world beside this one with other settings: what these cost, and what they miss."},
    Shortcut{GLFW_KEY_V, 0, "V", "Methods side by side",
             [](Session&, UiState& ui) { ui.toggle(LowerView::comparison); }, false, 0, false,
             [](const Session&, const UiState& ui) { return ui.lower == LowerView::comparison; },
             "Shows what each method costs and misses on the same frame."},
    Shortcut{GLFW_KEY_E, 0, "E", "Error against run time", [](Session&, UiState& ui) { ui.toggle(LowerView::sweep); },
             false, 0, false, [](const Session&, const UiState& ui) { return ui.lower == LowerView::sweep; },
             "Plots error against run time of the shown methods with many settings, on one frame."},
    Shortcut{GLFW_KEY_T, 0, "T", "Hash table", [](Session& s, UiState& ui) { ui.toggle_hash_table(s); }, false, 0,
             false, [](const Session&, const UiState& ui) { return ui.hash_table; },
             "Shows the hash table: each square is a bucket."},
    Shortcut{GLFW_KEY_W, 0, "W", "What the paper's method misses",
             [](Session&, UiState& ui) { ui.set_story(!ui.shows_story()); }, false, 0, false,
             [](const Session&, const UiState& ui) { return ui.shows_story(); },
             "A card counts what the paper's method misses, marks it in the scene, and says why.", true},
    Shortcut{GLFW_KEY_L, 0, "L", "Status lights", [](Session&, UiState& ui) { ui.lights = !ui.lights; }, false, 0,
             false, [](const Session&, const UiState& ui) { return ui.lights; },
             "Say what to expect of the method and of the time step.", true},
    Shortcut{GLFW_KEY_C, 0, "C", "Reset the camera", WindowTask::reset_camera},
    Shortcut{GLFW_KEY_P, 0, "P", "Take a picture", [](Session& s, UiState&) { s.exporter.picture_requested = true; }},
    Shortcut{GLFW_KEY_H, 0, "H", "Hide or show the panel", [](Session&, UiState& ui) { ui.panel = !ui.panel; }},
    Shortcut{GLFW_KEY_X, GLFW_KEY_F11, "X or F11", "Nothing but the scene",
             [](Session&, UiState& ui) { ui.clean = !ui.clean; }},
    Shortcut{GLFW_KEY_F1, '?', "F1 or ?", "Help", [](Session&, UiState& ui) { ui.help = !ui.help; }, false, 0, false,
             [](const Session&, const UiState& ui) { return ui.help; }, "Lists keys and mouse.", true},
    Shortcut{GLFW_KEY_ESCAPE, 0, "Esc", "Close help, tour, card; select nothing",
             [](Session& s, UiState& ui) {
               if (ui.popup_open) return;  // the key closes this list and nothing else
               if (ui.clean || ui.help) return void(ui.clean = ui.help = false);
               if (ui.tour.open()) return ui.tour.close(s, ui.overlays);
               if (ui.shows_story() && !s.bodies.selected() && !s.inspector.selected_bucket()) ui.set_story(false);
               s.bodies.select(std::nullopt);
               s.inspector.select_bucket(std::nullopt);
             }},
    Shortcut{GLFW_KEY_Q, 0, "Q", "Quit", WindowTask::quit},
};

constexpr std::array mouse_table{
    HelpLine{"On a body", "Drag: pull it"},
    HelpLine{"", "Click: select it"},
    HelpLine{"", "Double-click: look at it"},
    HelpLine{"On a solid", "Drag: move it"},
    HelpLine{"Background", "Drag: orbit"},
    HelpLine{"Middle drag", "Orbit, also from a body"},
    HelpLine{"Right drag", "Pan"},
    HelpLine{"Wheel", "Zoom"},
    HelpLine{"Drop files", "Mesh: a body. TOML: a scene"},
    HelpLine{"", "Meshes alike: plays them as frames"},
};

/// Returns a request for `action`, or for the reason where it needs a solver and there is none. `what`: the action.
Request with_solver(const Session& session, bool needs_solver, std::string_view what, Request action) {
  if (!needs_solver || session.simulated()) return action;
  return
      [what](Session& s, UiState&) { s.simulation.notice.tell(std::string(what) + ": left out, " + no_solver_text); };
}

}  // namespace

std::span<const Shortcut> shortcuts() {
  static_assert(shortcut_table.back().key == GLFW_KEY_Q);  // a page cannot quit
  return std::span(shortcut_table).first(shortcut_table.size() - (session::this_system().has_folders() ? 0 : 1));
}
std::span<const HelpLine> mouse_actions() { return mouse_table; }

std::optional<Request> request_by_key(const Session& session, int key, bool repeat, int mods) {
  // Shift is ignored where no shortcut asks for it. With one of these a key means something else in every program.
  constexpr int other_mods = GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
  for (const render::OverlayRow& row : render::overlay_table) {
    if (key != row.shortcut || repeat || mods & other_mods) continue;
    return with_solver(session, row.needs_solver, row.label,
                       [shown = row.shown](Session&, UiState& ui) { ui.overlays.*shown = !(ui.overlays.*shown); });
  }
  for (const Shortcut& shortcut : shortcuts()) {
    if (key != shortcut.key && (shortcut.other_key == 0 || key != shortcut.other_key)) continue;
    if ((mods & shortcut.mods) != shortcut.mods || (mods & ~shortcut.mods) & other_mods) continue;
    if (repeat && !shortcut.repeats) return std::nullopt;
    const auto request = [](const auto& act) { return Request(act); };
    return with_solver(session, shortcut.needs_solver, shortcut.text, std::visit(request, shortcut.act));
  }
  return std::nullopt;
}

}  // namespace app::ui
