#include "app/ui/views/story_card.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/views/status.h"
#include "app/ui/widgets/method_mark.h"

namespace app::ui {
namespace {

/// Returns the driving method, or the reference if the paper's method drives.
std::optional<std::size_t> exact_method(const Session& session) {
  const std::size_t driver = session.comparison.driver();
  if (collide::method_table()[driver].exact) return driver;
  return session.comparison.report().reference;
}

void draw_method(Widgets& w, const session::LiveComparison& comparison, std::size_t method, const char* remark) {
  const collide::Method& its = collide::method_table()[method];
  const compare::CompareRow* row = comparison.scored_row(method);
  draw_method_mark(w, its, ImGui::GetTextLineHeight());
  ImGui::SameLine();
  const std::string text = verdict(comparison, method), name = its.name;
  const bool narrow =
      ImGui::CalcTextSize((name + remark + text).c_str()).x > ImGui::GetContentRegionAvail().x - w.px(12);
  ImGui::Text("%s%s", name.c_str(), narrow ? "" : remark);
  ImGui::SameLine();
  const bool misses = row && !row->missed.empty();
  if (misses) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(render::contact_missed_colour));
  w.right_text(text);
  if (misses) ImGui::PopStyleColor();
  w.register_item(fmt::format("Story of {}", its.name), its.summary);
}

const char* reason(collide::Coverage coverage) {
  return coverage == collide::Coverage::exceeded
             ? "Why: some boxes are larger than a cell. Their corners skip cells, and what lies there is never "
               "compared."
             : "Why: a face of the grid lies between these vertices. Their boxes share no cell, so the paper's method "
               "never compares them.";
}

}  // namespace

/// Remembers the last miss, since contacts come and go fast.
void StoryCard::follow(const Session& session) {
  if (world_ != session.simulation.world_number()) last_.reset();
  world_ = session.simulation.world_number();
  if (reports_ == session.comparison.reports()) return;
  reports_ = session.comparison.reports();
  const compare::CompareReport& report = session.comparison.report();
  if (const compare::CompareRow* row = session.comparison.paper_row(); row && !row->missed.empty())
    last_ = {report.frame, row->missed.size(), report.true_contacts, row->coverage};
}

std::string StoryCard::sentence(const Session& session) const {
  const compare::CompareReport& report = session.comparison.report();
  if (report.id != 0 && !report.reference) return "Not measured here: " + report.reference_note + ".";
  const std::size_t paper = compare::method_index(collide::paper_method);
  if (!report.rows.empty() && !report.rows[paper].not_run.empty())
    return "The paper's method was not run: " + report.rows[paper].not_run + ".";
  const compare::CompareRow* row = session.comparison.paper_row();
  if (row && !row->missed.empty()) return reason(row->coverage);
  if (last_)
    return fmt::format("The paper's method last missed contacts in frame {} ({} of {}): {}.", last_->frame,
                       grouped(last_->missed), grouped(last_->contacts),
                       last_->coverage == collide::Coverage::exceeded
                           ? "some boxes were larger than a cell, and their corners skipped cells"
                           : "a face of the grid lay between the vertices");
  if (session.world().all_at_rest()) return "The boxes of each contact of this frame share a bucket.";
  return "Both look for all vertices that come closer than the tolerance. Watch what happens where bodies touch across "
         "a face of the grid.";
}

float StoryCard::draw(Widgets& w, const Session& session, const ScreenRect& area) {
  follow(session);
  box_.begin(w, "Story", area, box_width(w, area), true);
  if (w.closable_heading("Contacts found in the same frame###story",
                         "Puts this card away (W or Esc). W brings it back."))
    w.ask([](UiState& ui) { ui.set_story(false); });
  draw_method(w, session.comparison, compare::method_index(collide::paper_method), " (the paper's)");
  if (const auto exact = exact_method(session)) draw_method(w, session.comparison, *exact, "");
  // The sentence has the same height whatever its length, so that the button does not move.
  const float top = ImGui::GetCursorPosY(), lines = 2 * ImGui::GetTextLineHeight();
  w.wrapped_text("Story sentence", sentence(session));
  ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), top + lines + ImGui::GetStyle().ItemSpacing.y));
  const bool may_miss = !session.world().all_at_rest() ||
                        (session.comparison.paper_row() && !session.comparison.paper_row()->missed.empty());
  if (const Disabled off(!may_miss);
      w.button("Show me a miss###Explain story", "Opens the guided tour at its page on a missed contact."))
    w.ask([](Session& s, UiState& ui) { ui.tour.start(s, ui.overlays, miss_step); });
  return box_.end(area);
}

}  // namespace app::ui
