// The panel's widgets for the values of the scene, its block on the method, and its section on detection. What a widget
// says and where it ends stands in the row of its key.

#include <array>
#include <limits>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/render/palette.h"
#include "app/ui/panel/panel.h"
#include "app/ui/views/views.h"
#include "app/ui/widgets/method_mark.h"
#include "softbody/scene/scene_keys.h"

namespace app::ui {
namespace {

/// True if surface contact keeps the bodies apart, not the detector's contacts.
bool uses_surface_contact(const Session& session) {
  return edited(session.simulation).scene().contact_surface == softbody::ContactSurface::surfaces;
}

/// Draws the label of a setting of the hash function. If bucket count and primes do not suit each other, the label has
/// a mark, and the reason as its tooltip.
void draw_hash_label(Widgets& w, const std::string& label, float column, const collide::Settings& settings) {
  const std::string warning = collide::hash_warning(settings);
  if (warning.empty()) return w.row_label(label, column);
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, {0.85f, 0.5f, 0.0f, 1.0f});
  w.row_label(label + "!", column);
  ImGui::PopStyleColor();
  w.register_item(label + " warning", warning);
}

ValuePlace place_of(const softbody::Key& key) {
  using namespace softbody::scene_key;
  if (!softbody::is_of_detection(key)) return ValuePlace::world;
  if (&key == &levels || &key == &buckets || &key == &cell_size) return ValuePlace::hashing;
  return &key == &primes || &key == &self_collision ? ValuePlace::detection : ValuePlace::method;
}

/// Draws the widget for a value by its type. The functions return true if the user has changed it.
struct ValueWidgets {
  Widgets& w;
  const Session& session;
  float usual = session.simulation.loaded.scene.collision.tolerance;  // m: tells how large the bodies are
  const collide::Settings& settings = edited(session.simulation).collision();

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
    const collide::Method& method = edited(session.simulation).method();
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
    if (!session.edited_inspector().shown_method().uses_levels) return ImGui::TextDisabled("not used"), false;
    softbody::Slider s = key.slider;
    const std::string format = fmt::format("%d  ({} boxes per body)", grouped(1ull << value));
    s.format = format.c_str();
    return slide(key, value, s, " Keys:\u00a0[\u00a0and\u00a0].");
  }

  bool draw(const softbody::Key& key, std::uint32_t& value) const {
    draw_hash_label(w, key.slider.text, w.px(label_column), settings);
    return w.slider(key.slider.text, value, 1, collide::max_buckets, "%u", key.summary, true);
  }

  bool draw(const softbody::Key& key, std::array<std::uint32_t, 3>& value) const {
    static constexpr std::array labels{"x prime", "y prime", "z prime"};
    draw_hash_label(w, key.slider.text, w.px(62), settings);  // three numbers need more room than one
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
    softbody::Slider s = of_lengths(key.slider, 5, 50);
    const std::string format = std::string(s.format) + (value ? "" : "  (automatic)");
    s.format = format.c_str();
    const glm::vec3 now = *settings.cell_size;
    float side = std::max({now.x, now.y, now.z});
    if (!slide(key, side, s, " More, Detection: automatic cells.")) return false;
    value = glm::vec3(side);
    return true;
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

void draw_values(Widgets& w, const Session& session, ValuePlace place) {
  const ValueWidgets widgets{w, session};
  softbody::for_each_value(edited(session.simulation).scene(), [&](const softbody::Key& key, auto value) {
    if (!key.slider.text || place_of(key) != place) return;
    if (widgets.draw(key, value))
      w.ask([&key, value](Session& s) {
        s.simulation.change_scene(key.slider.text,
                                  [&](softbody::Scene& scene) { softbody::set_value(scene, key, value); });
      });
  });
}

void draw_method(Widgets& w, const Session& session) {
  draw_values(w, session, ValuePlace::method);
  ImGui::Separator();
  const collide::Method& owner = session.edited_inspector().shown_method();
  const bool drives = owner.key == edited(session.simulation).method().key;
  draw_method_mark(w, owner, ImGui::GetTextLineHeight());
  ImGui::SameLine();
  ImGui::TextDisabled("%s, %s", owner.key == collide::paper_method ? "The paper's method" : owner.name.c_str(),
                      drives ? "driving" : "for comparison");
  w.register_item("Hashing of", "Whose boxes and hash table these settings shape, and what it finds with them. " +
                                    (drives ? "" : edited(session.simulation).method().name + " has no hash table."));
  draw_values(w, session, ValuePlace::hashing);
  // The comparison is of the first world.
  const std::string found = &edited(session.simulation) == &session.world()
                                ? verdict(session.comparison, compare::method_index(owner.key))
                                : "see below the halves";
  const bool misses = found.starts_with("misses");
  if (misses) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(render::contact_missed_colour));
  w.figure("Contacts now", found, owner.summary);
  if (misses) ImGui::PopStyleColor();
}

void draw_detection(Widgets& w, const Session& session, const UiState&) {
  const std::optional<glm::vec3> cell_size = edited(session.simulation).scene().collision.cell_size;
  if (w.checkbox("Automatic cell size", !cell_size,
                 "Makes cells as large as the largest subdivided box at rest plus the tolerance. The paper's method "
                 "can still miss contacts."))
    w.ask([size = cell_size ? std::nullopt : edited(session.simulation).collision().cell_size](Session& s) {
      s.simulation.change_scene("Cell size", [&](softbody::Scene& scene) { scene.collision.cell_size = size; });
    });
  draw_values(w, session, ValuePlace::detection);
  ImGui::SameLine(w.px(label_column + 46));
  if (w.button("Restore settings", "Restores the method and settings of the scene file.",
               ImGui::GetContentRegionAvail().x))
    w.ask([](Session& s) { s.settings.restore_detection(); });
}

}  // namespace app::ui
