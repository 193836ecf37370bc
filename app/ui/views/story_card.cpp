#include "app/ui/views/story_card.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/render/palette.h"

namespace app::ui {
namespace {

constexpr float min_area_height = 420;  // for the sentence and the button, design pixels

const compare::CompareRow* paper_row(const Session& session) {
  return session.comparison.scored_row(compare::method_index(collide::paper_method));
}

/// Returns the driving method, or the reference if the paper's method drives.
std::optional<std::size_t> exact_method(const Session& session) {
  const std::size_t driver = session.comparison.driver();
  if (collide::method_table()[driver].exact) return driver;
  return session.comparison.report().reference;
}

void draw_method(Widgets& w, std::size_t method, const char* remark, std::optional<std::size_t> missed,
                 std::size_t contacts) {
  const collide::Method& row = collide::method_table()[method];
  w.swatch(row.colour, ImGui::GetTextLineHeight());
  ImGui::SameLine();
  ImGui::Text("%s%s", std::string(row.name).c_str(), remark);
  ImGui::SameLine();
  const bool misses = missed.value_or(0) > 0;
  if (misses) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(render::contact_missed_colour));
  w.right_text(!missed         ? "measuring"
               : contacts == 0 ? "no contacts yet"
               : misses        ? fmt::format("misses {} of {}", grouped(*missed), grouped(contacts))
                               : fmt::format("finds all {}", grouped(contacts)));
  if (misses) ImGui::PopStyleColor();
  w.register_item(fmt::format("Story of {}", row.name).c_str(), std::string(row.summary).c_str());
}

}  // namespace

/// Remembers the last miss, since contacts come and go fast.
void StoryCard::follow(const Session& session) {
  if (world_ != session.simulation.world_number()) last_.reset();
  world_ = session.simulation.world_number();
  if (std::exchange(reports_, session.comparison.reports()) == session.comparison.reports()) return;
  const compare::CompareReport& report = session.comparison.report();
  if (const compare::CompareRow* row = paper_row(session); row && !row->missed.empty())
    last_ = {report.frame, row->missed.size(), report.true_contacts};
}

std::string StoryCard::sentence(const Session& session) const {
  const compare::CompareReport& report = session.comparison.report();
  if (report.id != 0 && !report.reference) return "Not measured here: " + report.reference_note + ".";
  const compare::CompareRow* row = paper_row(session);
  if (row && !row->missed.empty() && row->coverage == collide::Coverage::exceeded)
    return "Why: a box is larger than a cell of the grid. Its corners skip cells, and what lies there is never "
           "compared.";
  if (row && !row->missed.empty())
    return "Why: the bodies touch across a face of the grid. Their boxes share no cell, so the paper's method never "
           "compares them.";
  if (last_)
    return fmt::format("Last missed: {} of {} contacts, in frame {}. There bodies touched across a face of the grid.",
                       grouped(last_->missed), grouped(last_->contacts), last_->frame);
  return "Both look for all vertices that come closer than the tolerance. Watch what happens where bodies touch across "
         "a face of the grid.";
}

StoryCard::Action StoryCard::draw(Widgets& w, const Session& session, const ScreenRect& area, bool at_bottom) {
  follow(session);
  Action action = Action::none;
  const float width = std::min(w.px(box_width), area.max.x - area.min.x - w.px(24));
  box_.begin(w, "Story", area, width, true, at_bottom);
  if (w.closable_heading("Contacts found in the same frame###story",
                         "Puts this card away (W or Esc). W brings it back."))
    action = Action::close;
  const std::size_t contacts = session.comparison.report().true_contacts;
  const compare::CompareRow* row = paper_row(session);
  draw_method(w, compare::method_index(collide::paper_method), " (the paper's)",
              row ? std::optional(row->missed.size()) : std::nullopt, contacts);
  if (const auto exact = exact_method(session))
    draw_method(w, *exact, "", row ? std::optional<std::size_t>(0) : std::nullopt, contacts);
  if (area.max.y - area.min.y >= w.px(min_area_height) && draw_why(w, session) != Action::none)
    action = Action::explain;
  box_.end();
  return action;
}

/// Draws the sentence in the same height whatever its length, so that the button does not move.
StoryCard::Action StoryCard::draw_why(Widgets& w, const Session& session) const {
  const float top = ImGui::GetCursorPosY(), lines = 2 * ImGui::GetTextLineHeight();
  ImGui::TextWrapped("%s", sentence(session).c_str());
  w.register_item("Story sentence", nullptr);
  ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), top + lines + ImGui::GetStyle().ItemSpacing.y));
  const bool clicked =
      w.button("Show me a miss###Explain story", "Opens the guided tour at its page on a missed contact.");
  return clicked ? Action::explain : Action::none;
}

}  // namespace app::ui
