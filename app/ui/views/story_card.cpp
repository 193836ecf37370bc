// The card of the first minute: the paper's method and an exact one on the same frame, what the former misses, and why.

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/views/views.h"
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

std::string missed_share(const compare::RunTotals& run) {
  return fmt::format("misses {:.2g} %", 100 * (1 - run.recall()));
}

/// Says what cells of half the automatic size cost, beside the exact method.
std::string small_cells_sentence(const compare::Price& price) {
  const auto& [cell, run] = price.runs[compare::Price::small_cells];
  const compare::RunTotals& exact = price.runs[compare::Price::exact].totals;
  std::string sunk = "nothing sinks";
  if (run.inside > 0)
    sunk = fmt::format("bodies end {:.2f} m inside each other", run.depth);
  else if (run.deepest > exact.deepest)
    sunk = fmt::format("bodies sink {:.2f} m into each other, but come out again", run.deepest);
  return fmt::format("Cells of {:.2f} m: the paper's method {}, takes {:.1f} times as long as the exact one, and {}.",
                     cell, missed_share(run), run.detect_ms / exact.detect_ms, sunk);
}

/// Says as honestly what the automatic cells cost.
std::string automatic_cells_sentence(const compare::Price& price, float tolerance) {
  const auto& [cell, run] = price.runs[compare::Price::automatic_cells];
  const std::string sunk = run.inside > 0 ? fmt::format("bodies end {:.2f} m inside each other", run.depth)
                                          : std::string("nothing ends inside another body");
  return fmt::format("Automatic cells ({:.2f} m): it {}, and {}. Bodies touch later, by up to {:.2g} m.", cell,
                     missed_share(run), sunk, tolerance);
}

/// Says what is missed in this frame and why, or why that is not known.
std::string miss_sentence(const Session& session) {
  const compare::CompareReport& report = session.comparison.report();
  if (report.id != 0 && !report.reference) return "Not measured here: " + report.reference_note + ".";
  const std::size_t paper = compare::method_index(collide::paper_method);
  if (!report.rows.empty() && !report.rows[paper].not_run.empty())
    return "The paper's method was not run: " + report.rows[paper].not_run + ".";
  const compare::CompareRow* row = session.comparison.paper_row();
  if (row && !row->missed.empty())
    return row->coverage == collide::Coverage::exceeded
               ? "Why: some boxes are larger than a cell. Their corners skip cells, and what lies there is never "
                 "compared."
               : "Why: a face of the grid lies between these vertices. Their boxes share no cell, so the paper's "
                 "method never compares them.";
  if (session.world().all_at_rest()) return "The boxes of each contact of this frame share a bucket.";
  return "Both look for all vertices that come closer than the tolerance. Watch what happens where bodies touch across "
         "a face of the grid.";
}

}  // namespace

void draw_story(Widgets& w, const Session& session) {
  draw_method(w, session.comparison, compare::method_index(collide::paper_method), " (the paper's)");
  if (const auto exact = exact_method(session)) draw_method(w, session.comparison, *exact, "");
}

void draw_story_sentences(Widgets& w, const Session& session) {
  const auto draw = [&w](const char* button, const char* tooltip, const char* label, const std::string& text,
                         const auto& request) {
    if (w.button(button, tooltip, w.px(120))) w.ask(request);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    w.wrapped_text(label, text);
  };
  const compare::Price* price = session.price.price();
  if (price && !price->failure.empty()) price = nullptr;
  if (price)
    draw("See it beside", "Starts the scene anew, with a second world beside it.", "Price",
         small_cells_sentence(*price), [](Session& s) {
           s.simulation.reset();
           if (!s.simulation.beside()) s.simulation.toggle_beside();
         });
  const bool may_miss = !session.world().all_at_rest() ||
                        (session.comparison.paper_row() && !session.comparison.paper_row()->missed.empty());
  const Disabled off(!may_miss);
  draw("Show me a miss###Explain story", "Opens the guided tour at its page on a missed contact.", "Story sentence",
       price ? automatic_cells_sentence(*price, session.world().collision().tolerance) : miss_sentence(session),
       [](Session& s, UiState& ui) { ui.tour.start(s, ui.overlays, miss_step); });
}

}  // namespace app::ui
