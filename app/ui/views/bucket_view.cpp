#include "app/ui/views/views.h"

#include <cassert>

#include <fmt/core.h>

#include "app/render/palette.h"

namespace app::ui {
namespace {

constexpr int list_lines = 4;  // visible; the list scrolls, so that the window keeps its height

std::string count_text(std::size_t n, const compare::BucketContents& bucket) {
  return fmt::format("{}{}{}", grouped(n), bucket.vertices ? " vert" : " box",
                     n == 1 ? (bucket.vertices ? "ex" : "") : (bucket.vertices ? "ices" : "es"));
}

void draw_group(Widgets& w, const Session& session, const compare::BucketContents& bucket,
                const compare::CellGroup& group, bool chosen) {
  const std::string cell = compare::cell_text(group.cell);
  w.swatch(chosen ? render::same_cell_colour : render::aliased_colour);
  const std::string bodies = bodies_text(group, bucket, session.inspector.shown_geometry(), session.world().bodies());
  const std::string text = wrapped(fmt::format("{}  {}, {}", cell, count_text(group.items.size(), bucket), bodies),
                                   ImGui::GetContentRegionAvail().x) +
                           "###Cell " + cell;
  const std::string tooltip =
      fmt::format("Cell {}: {} of {}. Click to show its entries in blue, and those of other cells in orange (§2.2).",
                  cell, count_text(group.items.size(), bucket), bodies);
  if (w.combo_item(text, chosen, tooltip)) w.ask([at = group.cell](Session& s) { s.inspector.select_cell(at); });
}

}  // namespace

void draw_bucket(Widgets& w, const Session& session) {
  const compare::BucketContents* bucket = session.inspector.bucket();
  assert(bucket);
  const std::string title = fmt::format("Bucket {}###Bucket", grouped(bucket->bucket));
  const bool close = w.closable_heading(title, "Deselects the bucket (Esc).");
  std::uint32_t number = bucket->bucket;
  w.row_label("Number", w.px(70));
  const bool another = w.number_field("Bucket number", number, 0, session.world().collision().buckets - 1,
                                      "Type the number of another bucket. The first is 0.");
  const std::size_t cells = bucket->groups.size();
  w.figure(count_text(bucket->items, *bucket), fmt::format("{}{}", cells, cells == 1 ? " cell" : " cells"),
           "The entries of the bucket, and the number of cells that they belong to (§2.2).");
  ImGui::BeginChild("Cells", {0, static_cast<float>(list_lines) * ImGui::GetTextLineHeightWithSpacing()});
  const compare::CellGroup* chosen = bucket->group(session.inspector.selected_cell());
  for (const compare::CellGroup& group : bucket->groups) draw_group(w, session, *bucket, group, &group == chosen);
  ImGui::EndChild();
  w.figure("Pairs", sharing_text(bucket->sharing),
           "Pairs of entries in this bucket: near ones of the same cell, and by chance, of different cells with the "
           "same hash (aliasing, §2.2). The latter cost tests for nothing.");
  w.figure("All pairs", sharing_text(session.inspector.table().sharing()), "The same pairs, summed over all buckets.");
  if (close || another)
    w.ask([to = close ? std::nullopt : std::optional(number)](Session& s) { s.inspector.select_bucket(to); });
}

}  // namespace app::ui
