// The hash table: a square for each bucket, coloured by its load.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/views/views.h"
#include "app/ui/widgets/bucket_grid.h"

namespace app::ui {
namespace {

constexpr float grid_height = 160;  // design pixels

void draw_squares(Widgets& w, const Session& session, const BucketGrid& grid, const ImVec2& size,
                  std::uint32_t max_load) {
  const std::vector<collide::BucketLoad>& squares = session.inspector.fullest_buckets(grid.per_square);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("##buckets", size);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(origin, {origin.x + size.x, origin.y + size.y}, to_imgui(glm::vec3(0.93f)), w.px(3));
  const float gap = grid.side >= w.px(6) ? std::max(1.0f, std::floor(w.px(1))) : 0.0f;
  const auto corner = [&](std::uint32_t s) {
    return ImVec2(origin.x + static_cast<float>(s % grid.columns) * grid.side,
                  origin.y + static_cast<float>(s / grid.columns) * grid.side);
  };
  const float scale = std::log2(static_cast<float>(std::max(2u, max_load)));
  for (std::uint32_t s = 0; s < grid.squares(); ++s) {
    const auto load = static_cast<float>(squares[s].load);
    if (load == 0 && gap == 0) continue;
    const ImVec2 at = corner(s);
    const glm::vec3 fill = load == 0 ? glm::vec3(0.86f) : render::sequential_colour(std::log2(load) / scale);
    draw->AddRectFilled(at, {at.x + grid.side - gap, at.y + grid.side - gap}, to_imgui(fill));
  }
  const auto outline = [&](std::uint32_t s, const glm::vec3& line, float thickness) {
    const ImVec2 at = corner(s);
    draw->AddRect({at.x - 1, at.y - 1}, {at.x + grid.side - gap + 1, at.y + grid.side - gap + 1}, to_imgui(line), 0,
                  ImDrawFlags_None, thickness);
  };
  const auto& selected = session.inspector.selected_bucket();
  if (selected) outline(*selected / grid.per_square, glm::vec3(0.8f, 0.0f, 0.4f), w.px(2));
  w.register_item("Buckets of the table");
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto under = ImGui::IsItemHovered() ? grid.square_at(mouse.x - origin.x, mouse.y - origin.y) : std::nullopt;
  if (!under) return;
  outline(*under, glm::vec3(0.1f), w.px(1.5f));
  const auto [fullest, load] = squares[*under];
  const std::uint32_t first = grid.first_bucket(*under), last = grid.last_bucket(*under);
  const std::string what = first == last ? fmt::format("Bucket {}, load {}", grouped(first), grouped(load))
                                         : fmt::format("Buckets {} to {}; the fullest is {} with load {}",
                                                       grouped(first), grouped(last), grouped(fullest), grouped(load));
  w.show_tooltip(what + ". Click to show its boxes in the scene, or to deselect it.");
  if (clicked)
    w.ask([to = selected == fullest ? std::nullopt : std::optional(fullest)](Session& s) {
      s.inspector.select_bucket(to);
    });
}

void draw_load_scale(Widgets& w, std::uint32_t max_load) {
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::TextDisabled("Load  1");
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float bar = width * 0.5f, height = ImGui::GetTextLineHeight();
  draw_colour_scale({at.x, at.y + 0.25f * height}, bar, at.y + 0.8f * height, 32, render::sequential_colour);
  ImGui::Dummy({bar, height});
  ImGui::SameLine();
  w.text_line(grouped(max_load));
  w.register_item("Load scale", fmt::format("Number of entries in a bucket, {} in the fullest. Grey squares are empty "
                                            "(§2.2).",
                                            grouped(max_load)));
}

void draw_summary(Widgets& w, const Session& session, const BucketGrid& grid) {
  const std::size_t used = session.inspector.shown_geometry().loads.size();
  std::string text = grouped(grid.buckets) + (grid.buckets == 1 ? " bucket, " : " buckets, ");
  text += used == 0 ? "none used" : grouped(used) + " used";
  if (grid.per_square > 1) text += ", " + grouped(grid.per_square) + " per square (the fullest shows)";
  w.pale_text(text);
  w.pale_text(shown_method_text(session));
}

}  // namespace

std::uint32_t longest_bucket(const collide::DebugGeometry& table) {
  return table.loads.empty() ? 0 : std::ranges::max(table.loads, {}, &collide::BucketLoad::load).load;
}

void draw_hash_table(Widgets& w, const Session& session) {
  if (w.closable_heading("Hash table", "Closes the hash table (T)."))
    w.ask([](Session& s, UiState& ui) { ui.toggle_hash_table(s); });
  const collide::DebugGeometry& table = session.inspector.shown_geometry();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, w.px(grid_height)};
  if (table.buckets == 0) {
    ImGui::Dummy({size.x, 0.4f * size.y});
    w.wrapped_text("No table",
                   fmt::format("The scene is too large to show the table of {} while it moves. Pause to see it.",
                               session.inspector.shown_method().name));
    ImGui::Dummy({size.x, 0.4f * size.y});
    return;
  }
  const BucketGrid grid = BucketGrid::fit(table.buckets, size.x, size.y, std::floor(w.px(min_square)));
  const std::vector<collide::BucketLoad>& squares = session.inspector.fullest_buckets(grid.per_square);
  const std::uint32_t max_load = std::max(1u, std::ranges::max(squares, {}, &collide::BucketLoad::load).load);
  draw_squares(w, session, grid, size, max_load);
  draw_load_scale(w, max_load);
  draw_summary(w, session, grid);
}

}  // namespace app::ui
