// The panel's sections for import and export: meshes, scenes, the command line; pictures, recordings, curves.

#include <algorithm>
#include <cfloat>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/session/system_files.h"
#include "app/ui/panel/panel.h"

namespace app::ui {
namespace {

constexpr int max_resolution = 3000;                         // particles: more are not simulated in real time
constexpr float narrow_column = 78, file_button_width = 62;  // design pixels

/// Draws a field with a button at its right. True if Enter is pressed or the button is clicked.
bool field_with_button(Widgets& w, const char* label, const std::string& value, const char* hint, const char* tooltip,
                       std::string& (*place)(Session&, UiState&), const char* button, const char* button_tooltip) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - w.px(file_button_width) - gap);
  const bool entered = w.text_field(label, value, hint, tooltip, place);
  ImGui::SameLine(0, gap);
  return w.button(button, button_tooltip, w.px(file_button_width)) || entered;
}

/// Draws what is wrong with the field above, if anything is.
void draw_problem(Widgets& w, const char* label, const std::string& problem) {
  if (!problem.empty()) w.wrapped_text(label, problem, true);
}

void draw_open(Widgets& w, const session::Import& import) {
  w.row_label("Open", w.px(narrow_column));
  const Disabled off(import.busy());
  if (!session::this_system().has_folders()) {
    if (w.button("Choose files", "Meshes (OBJ, PLY) or a scene. You can also drop files on the window.", -FLT_MIN))
      session::this_system().choose_files();
    return;
  }
  if (field_with_button(
          w, "File to open", import.path, "mesh.obj or scene.toml",
          "An OBJ or PLY file, which opens alone as a soft body, or a scene file. You can also drop files on the "
          "window.",
          [](Session& s, UiState&) -> std::string& { return s.import.path; }, "Load", "Reads the file."))
    w.ask([](Session& s) { s.import.load(); });
  draw_problem(w, "Load problem", import.problem());
}

/// Draws how the next mesh is imported.
void draw_mesh_settings(Widgets& w, const session::Import& import) {
  w.row_label("Size", w.px(narrow_column));
  const float check = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize("Z is up").x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - check - ImGui::GetStyle().ItemSpacing.x);
  float size = import.size;
  if (w.slider(
          "Size of meshes", size, session::Import::min_size, session::Import::max_size, "%.2f m",
          "The largest extent that the next mesh is scaled to, whatever its units are. The scenes' spheres have 1 m.",
          true))
    w.ask([size](Session& s) { s.import.size = size; });
  ImGui::SameLine();
  if (w.checkbox("Z is up", import.z_is_up, "In the file; else y is. It holds for the next mesh."))
    w.ask([](Session& s) { s.import.z_is_up = !s.import.z_is_up; });
  w.row_label("Weld", w.px(narrow_column));
  const double mm = 1e3 * double{import.size};  // of the mesh's size
  double weld = mm * import.weld;
  if (w.slider("Weld distance", weld, mm * session::Import::min_weld, mm * session::Import::max_weld, "%.4f mm",
               "Vertices of the next mesh that are no further apart become one. Raise it if seams stay open.", true))
    w.ask([part = std::clamp(weld / mm, session::Import::min_weld, session::Import::max_weld)](Session& s) {
      s.import.weld = part;
    });
  w.row_label("Particles", w.px(narrow_column));
  const bool automatic = import.resolution == 0;
  if (w.checkbox("Auto###Auto resolution", automatic,
                 fmt::format("A mesh of more than {} vertices is simulated by {} particles; its vertices follow them.",
                             grouped(softbody::max_simulated_vertices), grouped(softbody::default_resolution))))
    w.ask([automatic](Session& s) { s.import.resolution = automatic ? softbody::default_resolution : 0; });
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  const Disabled off(automatic);
  int resolution = static_cast<int>(automatic ? softbody::default_resolution : import.resolution);
  if (w.slider(
          "Particles of meshes", resolution, static_cast<int>(softbody::min_resolution), max_resolution, "%d",
          "How many particles simulate the next mesh if it has more vertices. More of them follow finer folds, and "
          "take longer."))
    w.ask([resolution](Session& s) { s.import.resolution = static_cast<std::size_t>(resolution); });
}

void save(Session& session, UiState& ui) {
  ui.save_question.clear();
  ui.save_problem.set(ui.save_as, session.scenes.save(ui.save_as, ui.view));
}

/// Draws the question whether to replace a file, below its field.
void draw_save_question(Widgets& w, const UiState& ui) {
  const std::string question = ui.save_question.about(ui.save_as);
  if (question.empty()) return;
  w.wrapped_text("Save question", question);
  ImGui::SetCursorPosX(w.px(narrow_column));
  if (w.button("Replace", "Writes the scene over the file.", w.px(file_button_width))) w.ask(save);
  ImGui::SameLine();
  if (w.button("Cancel", "The file stays as it is.", w.px(file_button_width)))
    w.ask([](UiState& state) { state.save_question.clear(); });
}

void draw_save(Widgets& w, const Session& session, const UiState& ui, bool saved) {
  w.row_label("Save as", w.px(narrow_column));
  const session::SceneFile& own = session.simulation.loaded.file;
  const bool as_named = saved && own.is_at(ui.save_as) && !own.changed_on_disk();
  if (field_with_button(
          w, "Scene file", ui.save_as, "scene.toml",
          "The scene with all settings in use but the integrator, and the camera as it is. Bodies that "
          "you dropped, threw or loaded are in it, each in the frame in which it came; what you pulled or "
          "deleted is as it was, so that their places need not be free then.",
          [](Session&, UiState& state) -> std::string& { return state.save_as; }, as_named ? "Saved###Save" : "Save",
          as_named ? "The file holds the scene as it is." : "Writes the file."))
    w.ask([](Session& s, UiState& state) {
      state.save_question.set(state.save_as, s.scenes.question_before_save(state.save_as));
      if (state.save_question.about(state.save_as).empty()) save(s, state);
    });
  draw_problem(w, "Save problem", ui.save_problem.about(ui.save_as));
  draw_save_question(w, ui);
}

/// Draws buttons that copy to the clipboard what starts the program so.
void draw_start(Widgets& w, const Session& session, const softbody::Scene& used, bool saved) {
  const session::System& system = session::this_system();
  w.row_label(system.start, w.px(narrow_column));
  const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  const auto draw_copy = [&](const char* name, const std::vector<std::string>& words, const char* does) {
    const std::string text = saved ? system.start_text(words) : "";
    constexpr std::size_t max_shown = 600;  // each frame that is played has a name
    const std::string shown = text.size() > max_shown ? text.substr(0, max_shown) + " ..." : text;
    if (!w.button(name, text.empty() ? system.no_start : shown, width, !text.empty())) return;
    ImGui::SetClipboardText(text.c_str());
    w.ask([does](Session& s) { s.simulation.notice.tell(std::string("Copied: what ") + does); });
  };
  if (const session::Player* player = session.simulation.player())
    return draw_copy("Copy", session::play_words(*player->recording(), used), "opens this scene");
  const softbody::World& world = *session.simulated();
  std::optional<compare::HowSimulated> beside;
  if (const session::Beside* second = session.simulation.beside())
    beside = {second->world().scene(), second->world().integrator_choice()};
  const std::vector<std::string> words =
      session::demo_words(session.simulation.loaded.file.name(), {used, world.integrator_choice()}, beside);
  draw_copy("Copy", words, "opens this scene");
  if (!system.has_folders()) return;
  // A body added since the last step shows here at once; `simulate` shows it only after the next step.
  const bool just_added = std::ranges::any_of(
      world.added(), [&](const auto& one) { return world.frame() > 0 && one.source.appear == world.frame(); });
  ImGui::SameLine();
  draw_copy("Copy simulate", session::simulate_words(words, world.frame() + (just_added ? 1 : 0)),
            "makes this picture");
}

/// Draws the choice of the pictures' size.
void draw_picture_size(Widgets& w, const session::Exporter& exporter) {
  using session::Exporter;
  const auto name_of = [](std::size_t size) {
    return std::string(size == Exporter::own ? "Own size" : Exporter::sizes[size].name);
  };
  w.row_label("Size", w.px(narrow_column));
  const Disabled off(exporter.with_panel || exporter.recording() || exporter.finishing());
  if (w.begin_combo("Picture size", exporter.with_panel ? "As the window" : name_of(exporter.size),
                    "Of pictures and videos of the scene without the panel. They show what the camera shows now.")) {
    for (std::size_t size = 0; size <= Exporter::own; ++size)
      if (w.combo_item(name_of(size), size == exporter.size)) w.ask([size](Session& s) { s.exporter.size = size; });
    ImGui::EndCombo();
  }
  if (exporter.size == Exporter::own && !exporter.with_panel) {
    w.row_label("", w.px(narrow_column));
    const float gap = ImGui::GetStyle().ItemSpacing.x, width = 0.5f * (ImGui::GetContentRegionAvail().x - gap);
    glm::uvec2 size = exporter.own_size;
    ImGui::SetNextItemWidth(width);
    w.number_field("Picture width", size.x, Exporter::min_side, Exporter::max_side, "In pixels.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    w.number_field("Picture height", size.y, Exporter::min_side, Exporter::max_side, "In pixels.");
    if (size != exporter.own_size) w.ask([size](Session& s) { s.exporter.own_size = size; });
  }
}

void draw_recording(Widgets& w, const session::Exporter& exporter) {
  w.row_label("Record", w.px(narrow_column));
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - w.px(file_button_width) - gap);
  ImGui::BeginDisabled(exporter.recording() || exporter.finishing());
  const std::span kinds = session::recording_kinds();
  const session::RecordingKind& now = kinds[exporter.kind];
  if (w.begin_combo("Kind of recording", now.name, now.tooltip)) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const session::RecordingKind& kind = kinds[i];
      if (w.combo_item(kind.name, i == exporter.kind, kind.tooltip)) w.ask([i](Session& s) { s.exporter.kind = i; });
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  ImGui::SameLine(0, gap);
  if (w.button(exporter.recording() ? "Stop###Record" : "Start###Record",
               "Every frame of the world from now on, until it is stopped. The world waits for the recording, so that "
               "no frame is lost.",
               w.px(file_button_width), !exporter.finishing()))
    w.ask([](Session& s) { s.exporter.toggle_recording(); });
}

}  // namespace

void draw_files(Widgets& w, const Session& session, const UiState& ui) {
  const bool has_solver = session.simulated();
  draw_open(w, session.import);
  if (has_solver) draw_mesh_settings(w, session.import);
  softbody::Scene used = session.scenes.with_added_bodies();
  used.view = ui.view;
  const session::LoadedScene& loaded = session.simulation.loaded;
  const bool saved = (!has_solver || !loaded.file.name().empty()) && session::options_make(used, loaded.scene);
  if (has_solver) draw_save(w, session, ui, saved);
  draw_start(w, session, used, saved);
}

void draw_export(Widgets& w, const Session& session, const UiState&) {
  const session::Exporter& exporter = session.exporter;
  if (session::this_system().has_folders()) {
    w.row_label("Folder", w.px(narrow_column));
    w.text_field("Output folder", exporter.folder, "the current one",
                 "Where all of this goes. Names end in the next free number; nothing is overwritten.",
                 [](Session& s, UiState&) -> std::string& { return s.exporter.folder; });
  }
  w.row_label("Take", w.px(narrow_column));
  const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  if (w.button("Picture", "A PNG file of the scene as it shows, in the size below (P).", width))
    w.ask([](Session& s) { s.exporter.picture_requested = true; });
  ImGui::SameLine();
  if (w.button("Curves", "The values of the panel's curves, as a CSV file.", width))
    w.ask([](Session& s) { s.exporter.write_curves(); });
  if (!session::recording_kinds().empty()) draw_recording(w, exporter);
  draw_picture_size(w, exporter);
  w.row_label("", w.px(narrow_column));
  if (w.checkbox("With the panel", exporter.with_panel,
                 "Pictures and videos show the whole window, else the scene alone."))
    w.ask([](Session& s) { s.exporter.with_panel = !s.exporter.with_panel; });
  w.wrapped_text("Message", exporter.message(), exporter.failed());
}

}  // namespace app::ui
