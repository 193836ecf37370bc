#include "app/ui/strip.h"

#include <algorithm>

#include "app/session/system_files.h"
#include "app/ui/views/views.h"

namespace app::ui {
namespace {

constexpr float strip_edge = 6, line_gap = 2, min_card_width = 310;  // design pixels

void draw_messages(Widgets& w, const Session& session, const std::string& no_room_message) {
  draw_import_report(w, session.import);
  draw_guest_report(w, session.guests);
  if (!no_room_message.empty()) w.wrapped_text("No room", no_room_message);
  const session::Notice& notice = session.simulation.notice;
  if (!notice.text().empty()) w.wrapped_text("Notice", notice.text(), notice.is_error());
}

/// Draws what to look at in the scene, and then what happens in it. Without the panel it also says what to try.
void draw_sentences(Widgets& w, const Session& session, bool panel) {
  constexpr int first_frames = 300;
  const std::string caption = session.simulation.caption();
  const bool opens = session.world().frame() < first_frames;
  w.wrapped_text("Scene sentence", caption.empty() || opens ? session.world().scene().look_at : caption);
  if (panel) return;
  w.pale_text(session.simulated()
                  ? session::this_system().how_to
                  : "Drag to orbit. Click a body to select it. V: compare the methods. G: tour. F1: help.");
}

}  // namespace

bool has_messages(const Session& session) {
  const session::Import& import = session.import;
  return !session.simulation.notice.text().empty() || !import.report().empty() || import.busy() ||
         !import.question().empty() || !session.guests.message().empty();
}

void Strip::draw_cards(Widgets& w, const Session& session, const UiState& ui, const Parts& parts) {
  const float side = ImGui::GetFrameHeight();
  const auto draw_closing = [&](const char* label, const char* tooltip, void (*put_away)(UiState&)) {
    ImGui::TableNextColumn();
    if (w.button(label, tooltip, side)) w.ask(put_away);
    ImGui::Dummy({});  // else the next column would align its text with the button's
  };
  const int cards = parts.lights && parts.story && parts.width >= w.px(2 * min_card_width) ? 4 : 2;
  if ((parts.lights || parts.story) && ImGui::BeginTable("Cards", cards)) {
    for (int i = 0; i < cards; ++i)
      ImGui::TableSetupColumn("", i % 2 ? ImGuiTableColumnFlags_WidthFixed : ImGuiTableColumnFlags_WidthStretch,
                              i % 2 ? side : 1);
    if (parts.lights) {
      ImGui::TableNextColumn();
      draw_status(w, session, ui.coverage_explained);
      draw_closing("x###Close lights", "Puts the lights away (L).", [](UiState& state) { state.lights = false; });
    }
    if (parts.story) {
      ImGui::TableNextColumn();
      draw_story(w, session);
      draw_closing("x###Close story", "Puts this card away (W or Esc). W brings it back.",
                   [](UiState& state) { state.set_story(false); });
    }
    ImGui::EndTable();
  }
  if (parts.story) draw_story_sentences(w, session);
  if (!parts.sidebar) draw_legend(w, session, ui.drawn_overlays(session), true, true);
}

void Strip::draw(Widgets& w, const Session& session, const UiState& ui, const Layout& layout) {
  const ScreenRect& area = *layout.strip;
  const bool all_shown = area.max.y - area.min.y >= height_;
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style.WindowPadding.x, w.px(strip_edge)});
  begin_dock("Strip", area, false, all_shown ? ImGuiWindowFlags_NoScrollbar : 0);
  ImGui::PopStyleVar();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, w.px(line_gap)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, w.px(line_gap)});
  w.keep_tooltips_off();
  const Parts parts{.width = area.max.x - area.min.x,
                    .cards = layout.cards,
                    .lights = ui.lights && !session.simulation.beside(),  // the two halves say it
                    .explained = ui.coverage_explained,
                    .story = ui.shows_story() && !session.simulation.beside(),
                    .sidebar = layout.sidebar.has_value(),
                    .messages = !layout.no_room_message.empty() || has_messages(session),
                    .legend = ui.overlays};
  if (layout.cards) draw_cards(w, session, ui, parts);
  if (parts.messages)
    draw_messages(w, session, layout.no_room_message);
  else
    draw_sentences(w, session, ui.panel);
  const float needed = ImGui::GetCursorPosY() - w.px(line_gap) + w.px(strip_edge);
  height_ = parts == parts_ ? std::max(height_, needed) : needed;
  parts_ = parts;
  ImGui::PopStyleVar(2);
  ImGui::End();
}

}  // namespace app::ui
