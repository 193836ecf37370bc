// The panel's widgets for the values of the scene, and its section on detection. What a widget says and where it ends
// stands in the row of its key.

#include <array>
#include <limits>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/ui/panel/panel.h"
#include "app/ui/views/views.h"
#include "app/ui/widgets/method_mark.h"
#include "softbody/scene/scene_keys.h"

namespace app::ui {
namespace {

constexpr std::array<std::uint32_t, 10> bucket_presets{1, 101, 499, 997, 1001, 1009, 10007, 100003, 1000003, 1u << 24};

/// True if surface contact keeps the bodies apart, not the detector's contacts.
bool uses_surface_contact(const Session& session) {
  return session.simulation.edited().scene().contact_surface == softbody::ContactSurface::surfaces;
}

/// Draws the label of a setting of the hash function. If bucket count and primes do not suit each other, the label has
/// a mark, and the reason as its tooltip.
void draw_hash_label(Widgets& w, const std::string& label, float column, const collide::Settings& settings, bool used) {
  const std::string warning = used ? collide::hash_warning(settings) : "";
  if (warning.empty()) return w.row_label(label, column);
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, {0.85f, 0.5f, 0.0f, 1.0f});
  w.row_label(label + "!", column);
  ImGui::PopStyleColor();
  w.register_item(label + " warning", warning);
}

/// Draws the widget for a value by its type. The functions return true if the user has changed it.
struct ValueWidgets {
  Widgets& w;
  const Session& session;
  bool needed;                                                        // by what is shown, besides the method
  float usual = session.simulation.loaded.scene.collision.tolerance;  // m: tells how large the bodies are
  const collide::Settings& settings = session.simulation.edited().collision();

  bool uses(const softbody::Key& key) const {
    using namespace softbody::scene_key;
    const collide::Method& method = session.simulation.edited().method();
    if (&key == &levels) return needed || method.uses_levels;
    return needed || method.uses_hash || (&key != &buckets && &key != &primes && &key != &cell_size);
  }
  void label(const softbody::Key& key) const { w.row_label(key.slider.text, w.px(label_column)); }

  /// more: what the tooltip says besides.
  template <class Value>
  bool slide(const softbody::Key& key, Value& value, const softbody::Slider& s, const std::string& more = "") const {
    const std::string tooltip = std::string(key.summary) + more;
    const auto least = static_cast<Value>(s.least), most = static_cast<Value>(s.most);
    return w.slider(s.text, value, least, most, s.format, tooltip, s.logarithmic);
  }
  /// Returns the slider of a length, which goes `below` and `above` the scene's tolerance.
  softbody::Slider of_lengths(softbody::Slider s, float below, float above) const {
    s.least = std::min(s.least, usual / below);
    s.most = std::max(s.most, usual * above);
    s.format = usual < 0.05f ? "%.3g m" : "%.3f m";  // a slider rounds its value to what it shows
    return s;
  }

  bool draw(const softbody::Key& key, double& value) const {
    label(key);
    return slide(key, value, key.slider);
  }

  /// A vector in the direction of the scene, downwards if it has none.
  bool draw(const softbody::Key& key, glm::dvec3& value) const {
    double strength = glm::length(value);
    if (!draw(key, strength)) return false;
    const glm::dvec3 loaded = session.simulation.loaded.scene.gravity;
    value = strength * (loaded == glm::dvec3(0.0) ? glm::dvec3(0, -1, 0) : glm::normalize(loaded));
    return true;
  }

  bool draw(const softbody::Key&, const std::string&) const {
    const collide::Method& method = session.simulation.edited().method();
    w.row_label("Method", w.px(label_column));
    draw_method_mark(w, method, ImGui::GetFrameHeight());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    std::string tooltip = method.description;
    if (uses_surface_contact(session)) tooltip += " With surface contact it does not move the bodies.";
    tooltip += " M: next shown method.";
    draw_method_choice(w, session, "Method", method.name, tooltip);
    return false;  // the list sets it
  }

  bool draw(const softbody::Key& key, softbody::ContactSurface& value) const {
    if (!session.simulated()) return false;
    label(key);
    const auto& info = *std::ranges::find(softbody::contact_surfaces, value, &softbody::ContactSurfaceInfo::value);
    const std::string tooltip = fmt::format("{} {} F: next.", key.summary, info.summary);
    if (!w.begin_combo("Contact surface", info.name, tooltip)) return false;
    for (const softbody::ContactSurfaceInfo& each : softbody::contact_surfaces)
      if (w.combo_item(each.name, &each == &info, each.summary)) value = each.value;
    ImGui::EndCombo();
    return value != info.value;
  }

  bool draw(const softbody::Key& key, int& value) const {
    label(key);
    if (&key != &softbody::scene_key::levels) return slide(key, value, key.slider);
    softbody::Slider s = key.slider;
    const std::string format = fmt::format("%d  ({} boxes per body)", grouped(1ull << value));
    s.format = format.c_str();
    return slide(key, value, s, " Keys [ and ].");
  }

  bool draw(const softbody::Key& key, std::uint32_t& value) const {
    draw_hash_label(w, key.slider.text, w.px(label_column), settings, uses(key));
    const float arrow = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float field_width = w.px(84);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - arrow - field_width - 2 * gap);
    bool changed = w.slider("Buckets", value, 1, collide::max_buckets, "", key.summary, true);
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(field_width);
    changed |= w.number_field("Number of buckets", value, 1, collide::max_buckets, key.summary);
    ImGui::SameLine(0, gap);
    if (w.begin_combo("Bucket presets", "", "Common numbers of buckets: the paper's, and primes near them.",
                      ImGuiComboFlags_NoPreview)) {
      for (const std::uint32_t preset : bucket_presets) {
        if (!w.combo_item(grouped(preset), preset == value)) continue;
        value = preset;
        changed = true;
      }
      ImGui::EndCombo();
    }
    return changed;
  }

  bool draw(const softbody::Key& key, std::array<std::uint32_t, 3>& value) const {
    static constexpr std::array labels{"x prime", "y prime", "z prime"};
    draw_hash_label(w, key.slider.text, w.px(62), settings, uses(key));  // three numbers need more room than one
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {w.px(3), ImGui::GetStyle().FramePadding.y});
    const float reset = ImGui::GetFrameHeight(), gap = w.px(3);
    const float field = (ImGui::GetContentRegionAvail().x - reset - 3 * gap) / 3;
    bool changed = false;
    for (std::size_t axis = 0; axis < labels.size(); ++axis) {
      ImGui::SetNextItemWidth(field);
      changed |= w.number_field(labels[axis], value[axis], 1, std::numeric_limits<std::uint32_t>::max(), key.summary);
      ImGui::SameLine(0, gap);
    }
    if (w.button("x###Default primes", "Restores the default: 73856093, 19349669, 83492791.", reset)) {
      value = collide::default_primes;
      changed = true;
    }
    ImGui::PopStyleVar();
    return changed;
  }

  bool draw(const softbody::Key& key, std::optional<glm::vec3>& value) const {
    label(key);
    bool changed = w.checkbox("Auto", !value,
                              "Makes cells as large as the largest subdivided box at rest plus the tolerance. The "
                              "paper's method can still miss contacts.");
    const glm::vec3 now = *settings.cell_size;
    if (changed) value = value ? std::nullopt : std::optional(now);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const Disabled off(!value);
    float side = std::max({now.x, now.y, now.z});
    if (slide(key, side, of_lengths(key.slider, 5, 50))) {
      value = glm::vec3(side);
      changed = true;
    }
    return changed;
  }

  bool draw(const softbody::Key& key, float& value) const {
    label(key);
    if (&key != &softbody::scene_key::tolerance) return slide(key, value, key.slider);
    const char* more = !session.simulated()            ? ""
                       : uses_surface_contact(session) ? " With surface contact they do not push each other."
                                                       : " They push each other apart.";
    return slide(key, value, of_lengths(key.slider, 20, 5), more);
  }

  bool draw(const softbody::Key& key, bool& value) const {
    if (!w.checkbox(key.slider.text, value, key.summary)) return false;
    value = !value;
    return true;
  }
};

}  // namespace

void draw_values(Widgets& w, const Session& session, const UiState& ui, bool of_detection) {
  // A setting is enabled if the driving method, the structure shown (§2) or the comparison uses it.
  const bool structure_shown =
      ui.hash_table || ui.tour.open() || render::shows(ui.overlays, render::OverlayBasis::table);
  const bool needed = structure_shown || session.inspector.selected_bucket() || session.comparison.choice.on ||
                      session.comparison.choice.with_paper || session.comparison.choice.with_misses;
  const ValueWidgets widgets{w, session, needed};
  softbody::for_each_value(session.simulation.edited().scene(), [&](const softbody::Key& key, auto value) {
    if (!key.slider.text || softbody::is_of_detection(key) != of_detection) return;
    const Disabled off(!widgets.uses(key));
    if (widgets.draw(key, value))
      w.ask([&key, value](Session& s) {
        s.simulation.change_scene(key.slider.text,
                                  [&](softbody::Scene& scene) { softbody::set_value(scene, key, value); });
      });
  });
}

void draw_detection(Widgets& w, const Session& session, const UiState& ui) {
  draw_values(w, session, ui, true);
  ImGui::SameLine(w.px(label_column + 46));
  if (w.button("Restore settings", "Restores the method and settings of the scene file.",
               ImGui::GetContentRegionAvail().x))
    w.ask([](Session& s) { s.settings.restore_detection(); });
}

}  // namespace app::ui
