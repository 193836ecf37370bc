#include "app/ui/views/hash_table_view.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "app/render/palette.h"
#include "app/ui/views/status.h"

namespace app::ui {
namespace {

constexpr float grid_height = 160, min_square = 4;  // design pixels

constexpr const char* click_tooltip = "Click to show its boxes in the scene, or to deselect it.";

}  // namespace

TableFigures table_figures(const collide::DebugGeometry& geometry) {
  TableFigures figures{.boxes = geometry.boxes.size(), .buckets_used = geometry.loads.size()};
  for (const auto& [bucket, load] : geometry.loads) figures.longest = std::max(figures.longest, load);
  return figures;
}

void HashTableView::refresh(const Session& session, float width, float height, float min_side) {
  const collide::DebugGeometry& debug = session.inspector.shown_geometry();
  const BucketGrid grid = BucketGrid::fit(debug.buckets, width, height, min_side);
  const bool same =
      revision_ == session.simulation.revision() && grid.side == grid_.side && grid.per_square == grid_.per_square;
  grid_ = grid;
  if (same) return;
  revision_ = session.simulation.revision();
  squares_.resize(grid_.squares());
  for (std::uint32_t s = 0; s < grid_.squares(); ++s) squares_[s] = {0, grid_.first_bucket(s)};
  for (const auto& [bucket, load] : debug.loads) {
    Square& square = squares_[bucket / grid_.per_square];
    if (load > square.load || (load == square.load && bucket < square.fullest)) square = {load, bucket};
  }
  figures_ = table_figures(debug);
  max_load_ = std::max(8u, std::bit_ceil(figures_.longest));
}

glm::vec3 HashTableView::colour(std::uint32_t load) const {
  return render::sequential_colour(std::log2(static_cast<float>(load)) / std::log2(static_cast<float>(max_load_)));
}

void HashTableView::draw_squares(Widgets& w, const Session& session, float width, float height) {
  origin_ = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("##buckets", {width, height});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(origin_, {origin_.x + width, origin_.y + height}, to_imgui(glm::vec3(0.93f)), w.px(3));
  const float gap = grid_.side >= w.px(6) ? std::max(1.0f, std::floor(w.px(1))) : 0.0f;
  const auto corner = [&](std::uint32_t s) {
    return ImVec2(origin_.x + static_cast<float>(s % grid_.columns) * grid_.side,
                  origin_.y + static_cast<float>(s / grid_.columns) * grid_.side);
  };
  for (std::uint32_t s = 0; s < grid_.squares(); ++s) {
    if (squares_[s].load == 0 && gap == 0) continue;
    const ImVec2 at = corner(s);
    const glm::vec3 fill = squares_[s].load == 0 ? glm::vec3(0.86f) : colour(squares_[s].load);
    draw->AddRectFilled(at, {at.x + grid_.side - gap, at.y + grid_.side - gap}, to_imgui(fill));
  }
  const auto outline = [&](std::uint32_t s, const glm::vec3& line, float thickness) {
    const ImVec2 at = corner(s);
    draw->AddRect({at.x - 1, at.y - 1}, {at.x + grid_.side - gap + 1, at.y + grid_.side - gap + 1}, to_imgui(line), 0,
                  ImDrawFlags_None, thickness);
  };
  const auto& selected = session.inspector.selected_bucket();
  if (selected) outline(*selected / grid_.per_square, glm::vec3(0.8f, 0.0f, 0.4f), w.px(2));

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto under = ImGui::IsItemHovered() ? grid_.square_at(mouse.x - origin_.x, mouse.y - origin_.y) : std::nullopt;
  std::string tooltip;
  if (under) {
    outline(*under, glm::vec3(0.1f), w.px(1.5f));
    const Square& square = squares_[*under];
    const std::uint32_t first = grid_.first_bucket(*under), last = grid_.last_bucket(*under);
    tooltip = first == last ? "Bucket " + grouped(first) + ", load " + grouped(square.load) + ". "
                            : "Buckets " + grouped(first) + " to " + grouped(last) + "; the fullest is " +
                                  grouped(square.fullest) + " with load " + grouped(square.load) + ". ";
    tooltip += click_tooltip;
    if (clicked)
      w.ask([to = selected == square.fullest ? std::nullopt : std::optional(square.fullest)](Session& s) {
        s.inspector.select_bucket(to);
      });
  }
  w.register_item("Buckets of the table");
  if (under) w.show_tooltip(tooltip);
}

void HashTableView::draw_legend(Widgets& w) const {
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::TextDisabled("Load  1");
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float bar = width * 0.5f, height = ImGui::GetTextLineHeight();
  draw_colour_scale({at.x, at.y + 0.25f * height}, bar, at.y + 0.8f * height, 32, render::sequential_colour);
  ImGui::Dummy({bar, height});
  ImGui::SameLine();
  w.text_line(grouped(max_load_));
  w.register_item("Load scale", "Number of entries in a bucket. Grey squares are empty (§2.2).");
}

void HashTableView::draw_summary(const Session& session) const {
  std::string text = grouped(grid_.buckets) + (grid_.buckets == 1 ? " bucket, " : " buckets, ");
  text += figures_.buckets_used == 0 ? "none used" : grouped(figures_.buckets_used) + " used";
  if (grid_.per_square > 1) text += ", " + grouped(grid_.per_square) + " per square (the fullest shows)";
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::TextDisabled("%s", shown_method_text(session).c_str());
}

void HashTableView::draw(Widgets& w, const Session& session) {
  if (w.closable_heading("Hash table", "Closes the hash table (T)."))
    w.ask([](Session& s, UiState& ui) { ui.toggle_hash_table(s); });
  const float width = ImGui::GetContentRegionAvail().x, height = w.px(grid_height);
  if (session.inspector.shown_geometry().buckets == 0) {
    ImGui::Dummy({width, 0.4f * height});
    ImGui::TextWrapped("The scene is too large to show the table of %s while it moves. Pause to see it.",
                       session.inspector.shown_method().name.c_str());
    ImGui::Dummy({width, 0.4f * height});
  } else {
    refresh(session, width, height, std::floor(w.px(min_square)));
    draw_squares(w, session, width, height);
    draw_legend(w);
    draw_summary(session);
  }
}

}  // namespace app::ui
