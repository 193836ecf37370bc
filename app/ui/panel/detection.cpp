// The panel's section on the method and its settings.

#include <array>
#include <limits>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "app/ui/views/views.h"
#include "app/ui/widgets/method_mark.h"

namespace app::ui {
namespace {

constexpr std::array<std::uint32_t, 10> bucket_presets{1, 101, 499, 997, 1001, 1009, 10007, 100003, 1000003, 1u << 24};

/// True if surface contact keeps the bodies apart, not the detector's contacts.
bool uses_surface_contact(const Session& session) {
  return session.world().scene().contact_surface == softbody::ContactSurface::surfaces;
}

void draw_method(Widgets& w, Session& session) {
  const collide::Method& method = session.world().method();
  w.row_label("Method", w.px(label_column));
  draw_method_mark(w, method, ImGui::GetFrameHeight());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  std::string tooltip = method.description;
  if (uses_surface_contact(session)) tooltip += " With surface contact it does not move the bodies.";
  tooltip += " M: next shown method.";
  draw_method_choice(w, session, "Method", method.name.c_str(), tooltip.c_str());
}

void draw_contact_surface(Widgets& w, Session& session) {
  const softbody::ContactSurface now = session.world().scene().contact_surface;
  w.row_label("Contact", w.px(label_column));
  const auto text = [](std::string_view part) { return std::string(part); };
  const auto& info = *std::ranges::find(softbody::contact_surfaces, now, &softbody::ContactSurfaceInfo::value);
  const std::string tooltip = "What pushes bodies apart. " + text(info.summary) + " F: next.";
  if (!w.begin_combo("Contact surface", text(info.name).c_str(), tooltip.c_str())) return;
  softbody::ContactSurface chosen = now;
  for (const softbody::ContactSurfaceInfo& each : softbody::contact_surfaces) {
    if (w.combo_item(text(each.name).c_str(), each.value == now, text(each.summary).c_str())) chosen = each.value;
  }
  ImGui::EndCombo();
  session.settings.set_contact_surface(chosen);
}

/// Returns the format of lengths in a scene with this tolerance (m). A slider rounds its value to what it shows.
const char* length_format(float usual) { return usual < 0.05f ? "%.3g m" : "%.3f m"; }

bool draw_levels(Widgets& w, collide::Settings& settings, bool used) {
  ImGui::BeginDisabled(!used);
  w.row_label("Subdivision", w.px(label_column));
  const std::string format = fmt::format("%d  ({} boxes per body)", grouped(1ull << settings.levels));
  const bool changed =
      w.slider("Subdivision level", settings.levels, 0, collide::max_levels, format.c_str(),
               "Level n cuts the box of a body into 2^n boxes (§2.1; the paper uses 3). Keys [ and ].");
  ImGui::EndDisabled();
  return changed;
}

/// Draws the label of a setting of the hash function. If bucket count and primes do not suit each other, the label has
/// a mark, and the reason as its tooltip.
void draw_hash_label(Widgets& w, const std::string& label, float column, const collide::Settings& settings, bool used) {
  const std::string warning = used ? collide::hash_warning(settings) : "";
  if (warning.empty()) return w.row_label(label.c_str(), column);
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, {0.85f, 0.5f, 0.0f, 1.0f});
  w.row_label((label + "!").c_str(), column);
  ImGui::PopStyleColor();
  w.register_item((label + " warning").c_str(), warning.c_str());
}

bool draw_buckets(Widgets& w, collide::Settings& settings, bool used) {
  static constexpr const char* tooltip =
      "The number of buckets of the hash table (§2.2; the paper uses 101 and 1001). "
      "If there are few, different cells share a bucket (aliasing).";
  ImGui::BeginDisabled(!used);
  draw_hash_label(w, "Buckets", w.px(label_column), settings, used);
  const float arrow = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float field_width = w.px(84);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - arrow - field_width - 2 * gap);
  bool changed = w.slider("Buckets", settings.buckets, 1, collide::max_buckets, tooltip);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(field_width);
  changed |= w.number_field("Number of buckets", settings.buckets, 1, collide::max_buckets, tooltip);
  ImGui::SameLine(0, gap);
  if (w.begin_combo("Bucket presets", "", "Common numbers of buckets: the paper's, and primes near them.",
                    ImGuiComboFlags_NoPreview)) {
    for (const std::uint32_t preset : bucket_presets) {
      if (!w.combo_item(grouped(preset).c_str(), preset == settings.buckets, nullptr)) continue;
      settings.buckets = preset;
      changed = true;
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  return changed;
}

bool draw_primes(Widgets& w, collide::Settings& settings, bool used) {
  static constexpr const char* tooltip =
      "The hash function multiplies a cell's x, y and z by these factors (§2.2). If a factor is 0 modulo the number "
      "of buckets, its axis has no effect.";
  static constexpr std::array labels{"x prime", "y prime", "z prime"};
  ImGui::BeginDisabled(!used);
  draw_hash_label(w, "Primes", w.px(62), settings, used);  // three numbers need more room than one
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {w.px(3), ImGui::GetStyle().FramePadding.y});
  const float reset = ImGui::GetFrameHeight(), gap = w.px(3);
  const float field = (ImGui::GetContentRegionAvail().x - reset - 3 * gap) / 3;
  bool changed = false;
  for (std::size_t axis = 0; axis < labels.size(); ++axis) {
    ImGui::SetNextItemWidth(field);
    changed |=
        w.number_field(labels[axis], settings.primes[axis], 1, std::numeric_limits<std::uint32_t>::max(), tooltip);
    ImGui::SameLine(0, gap);
  }
  if (w.button("x###Default primes", "Restores the default: 73856093, 19349669, 83492791.", reset)) {
    settings.primes = collide::default_primes;
    changed = true;
  }
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
  return changed;
}

/// usual: the scene's tolerance (m), which tells how large its bodies are.
bool draw_cell_size(Widgets& w, collide::Settings& settings, bool& automatic, bool used, float usual) {
  ImGui::BeginDisabled(!used);
  w.row_label("Cell size", w.px(label_column));
  bool changed =
      w.checkbox("Auto", automatic,
                 "Makes cells as large as the largest subdivided box at rest plus the tolerance. The paper's "
                 "method can still miss contacts.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::BeginDisabled(automatic);
  float side = std::max({settings.cell_size.x, settings.cell_size.y, settings.cell_size.z});
  if (w.slider(
          "Cell size", side, std::min(min_cell, usual / 5), std::max(max_cell, usual * 50), length_format(usual),
          "The side of a grid cell (§2.2). If it is smaller than a subdivided box, the paper's method skips cells.",
          true)) {
    settings.cell_size = glm::vec3(side);
    changed = true;
  }
  ImGui::EndDisabled();
  ImGui::EndDisabled();
  return changed;
}

}  // namespace

void draw_detection(Widgets& w, Session& session, UiState& ui) {
  draw_method(w, session);
  const collide::Method& method = session.world().method();
  collide::Settings settings = session.world().collision();
  bool automatic = session.world().scene().default_cell_size;
  // A setting is enabled if the driving method, the structure shown (§2) or the comparison uses it.
  const bool structure_shown = ui.hash_table || ui.tour.open() || ui.overlays.boxes || ui.overlays.cells;
  const bool needed = structure_shown || session.inspector.selected_bucket() || session.comparison.choice.on ||
                      session.comparison.choice.with_paper || session.comparison.choice.with_misses;
  const bool hash = method.uses_hash || needed;
  const float usual = session.simulation.loaded.scene.collision.tolerance;  // the scene's
  bool changed = draw_levels(w, settings, method.uses_levels || needed);
  changed |= draw_buckets(w, settings, hash);
  changed |= draw_primes(w, settings, hash);
  changed |= draw_cell_size(w, settings, automatic, hash, usual);
  if (session.simulated()) draw_contact_surface(w, session);
  w.row_label("Tolerance", w.px(label_column));
  changed |= w.slider(
      "Tolerance", settings.tolerance, std::min(min_tolerance, usual / 20), std::max(max_tolerance, usual * 5),
      length_format(usual),
      !session.simulated() ? "Vertices closer than this are in contact (§2.3)."
      : uses_surface_contact(session)
          ? "Vertices closer than this are in contact (§2.3). With surface contact they do not push each other."
          : "Vertices closer than this are in contact and push each other apart (§2.3).",
      true);
  changed |= w.checkbox("Self-collision", settings.self_collision,
                        uses_surface_contact(session)
                            ? "Also finds contacts of a body with itself (§2.4)."
                            : "Also finds pairs of vertices of one body (§2.4), except those that an edge joins or "
                              "that are as close at rest.");
  ImGui::SameLine(w.px(label_column + 46));
  if (w.button("Restore settings", "Restores the method and settings of the scene file.",
               ImGui::GetContentRegionAvail().x)) {
    session.settings.restore_detection();
  } else if (changed) {
    session.settings.set_collision(settings, automatic);
  }
}

}  // namespace app::ui
