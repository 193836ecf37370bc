#include "app/ui/bucket_view.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/render/palette.h"

namespace app {
namespace {

constexpr int list_lines = 4;  // of the list: it scrolls, so that the window keeps its height

std::string count_of(std::size_t n, const BucketContents& bucket) {
  return fmt::format("{}{}{}", grouped(n), bucket.vertices ? " vert" : " box",
                     n == 1 ? (bucket.vertices ? "ex" : "") : (bucket.vertices ? "ices" : "es"));
}

void draw_group(Widgets& w, Session& session, const BucketContents& bucket, const CellGroup& group, bool chosen) {
  const std::string cell = cell_text(group.cell);
  w.chip(chosen ? same_cell_colour : aliased_colour, ImGui::GetTextLineHeight());
  ImGui::SameLine();
  const std::string bodies = bodies_of(group, bucket, session.debug(), session.world().vertex_body());
  const std::string text =
      fmt::format("{}  {}, {}###Cell {}", cell, count_of(group.items.size(), bucket), bodies, cell);
  const std::string tooltip = fmt::format(
      "Cell {}: {} of {}. Click: what shares this cell turns blue; all else is in this bucket only because the modulo "
      "gave both cells one number (§2.2).",
      cell, count_of(group.items.size(), bucket), bodies);
  const bool clicked = ImGui::Selectable(text.c_str(), chosen);
  w.done(text.c_str(), tooltip.c_str());
  if (clicked) session.select_cell(group.cell);
}

void draw_meetings(Widgets& w, const char* label, const Sharing& sharing, const char* tooltip) {
  w.figure(label, fmt::format("{} / {}", grouped(sharing.same_cell), grouped(sharing.aliased)), tooltip);
}

}  // namespace

std::string cell_text(const Cell& cell) { return fmt::format("({}, {}, {})", cell[0], cell[1], cell[2]); }

std::string bodies_of(const CellGroup& group, const BucketContents& bucket, const collide::DebugGeometry& debug,
                      std::span<const softbody::BodyId> vertex_body) {
  constexpr std::size_t most = 3;
  std::vector<softbody::BodyId> bodies;
  for (const collide::Index item : group.items)
    bodies.push_back(bucket.vertices ? vertex_body[item] : debug.boxes[item].body);
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::string text = bodies.size() == 1 ? "body " : "bodies ";
  const std::size_t named = bodies.size() <= most ? bodies.size() : most - 1;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) text += i + 1 == bodies.size() ? " and " : ", ";
    text += std::to_string(bodies[i]);
  }
  if (named < bodies.size()) text.append(" and ").append(std::to_string(bodies.size() - named)).append(" more");
  return text;
}

void draw_bucket(Widgets& w, Session& session) {
  const BucketContents* bucket = session.bucket();
  const std::string title = fmt::format("Bucket {}###Bucket", grouped(bucket->bucket));
  const bool close = w.heading(title.c_str(), "Releases the bucket (Esc).");
  std::uint32_t number = bucket->bucket;
  w.row("Number", w.px(70));
  const bool another = w.number("Bucket number", number, 0, session.world().collision().buckets - 1,
                                "Type the number of another bucket: from 0, below the number of buckets (§2.2).");
  const std::size_t cells = bucket->groups.size();
  w.figure(count_of(bucket->items, *bucket).c_str(), fmt::format("{}{}", cells, cells == 1 ? " cell" : " cells"),
           "What is in the bucket, and the different cells that it comes from (§2.2).");
  ImGui::BeginChild("Cells", {0, static_cast<float>(list_lines) * ImGui::GetTextLineHeightWithSpacing()});
  const CellGroup* chosen = bucket->group(session.selected_cell());
  for (const CellGroup& group : bucket->groups) draw_group(w, session, *bucket, group, &group == chosen);
  ImGui::EndChild();
  draw_meetings(w, "Same cell / aliased", bucket->sharing,
                "Pairs that meet in this bucket: in one cell, as neighbours should, and of different cells, which the "
                "modulo put together. Aliased pairs cost tests and find nothing that is near (§2.2).");
  draw_meetings(w, "Whole table", session.table().sharing(), "The same, summed over all buckets.");
  if (close)
    session.select_bucket(std::nullopt);
  else if (another)
    session.select_bucket(number);
}

}  // namespace app
