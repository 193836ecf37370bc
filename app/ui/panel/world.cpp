// The panel's sections on solids, gravity and materials, which can be changed while the world runs.

#include <algorithm>
#include <cassert>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "softbody/mechanics/material_keys.h"

namespace app::ui {
namespace {

/// Draws a list of `count` items (at least one) and returns the chosen index.
template <class Name>
std::size_t choose(Widgets& w, const char* label, const char* tooltip, std::size_t chosen, std::size_t count,
                   const Name& name) {
  assert(count > 0);
  chosen = std::min(chosen, count - 1);
  w.row_label(label, w.px(label_column));
  if (!w.begin_combo(label, name(chosen), tooltip)) return chosen;
  for (std::size_t i = 0; i < count; ++i)
    if (w.combo_item(name(i), i == chosen)) chosen = i;
  ImGui::EndCombo();
  return chosen;
}

void ask_for_material(Widgets& w, std::size_t index, std::string_view what, const softbody::Material& material) {
  w.ask([=](Session& session) {
    session.simulation.change_scene(fmt::format("{} of {}", what, material.name),
                                    [&](softbody::Scene& scene) { scene.materials[index] = material; });
  });
}

/// Offers the presets for a material of the scene, which keeps its name.
void draw_preset(Widgets& w, const Session& session, std::size_t index) {
  const softbody::Material& now = session.world().scene().materials[index];
  const auto renamed = [&](softbody::Material preset) {
    preset.name = now.name;
    constexpr const softbody::Key& key = softbody::Material::start_in_equilibrium;
    preset[key] = now[key];
    return preset;
  };
  const auto& presets = session.scenes.presets();
  const auto same = std::ranges::find(presets, now, renamed);
  w.row_label("Preset", w.px(label_column));
  if (!w.begin_combo("Material preset", same == presets.end() ? "Custom" : same->name,
                     "Sets all values below to those of a known material."))
    return;
  for (const softbody::Material& preset : presets)
    if (w.combo_item(preset.name, renamed(preset) == now)) ask_for_material(w, index, "Preset", renamed(preset));
  ImGui::EndCombo();
}

void draw_material(Widgets& w, const Session& session, const UiState& ui) {
  const std::vector<softbody::Material>& all = session.world().scene().materials;
  const std::size_t chosen =
      choose(w, "Material", "The material to edit.", ui.material, all.size(),
             [&](std::size_t i) { return all[i].name.empty() ? "material " + std::to_string(i + 1) : all[i].name; });
  if (chosen != ui.material) w.ask([chosen](UiState& state) { state.material = chosen; });
  draw_preset(w, session, chosen);
  for (const softbody::Key* key : softbody::material_keys()) {
    const softbody::Slider& s = key->slider;
    if (!s.text) continue;
    softbody::Material changed = all[chosen];
    double shown = changed[*key] / s.unit;
    w.row_label(s.text, w.px(label_column));
    if (!w.slider(key->name, shown, s.least, s.most, s.format, key->summary, s.logarithmic)) continue;
    changed[*key] = shown * s.unit;
    ask_for_material(w, chosen, s.text, changed);
  }
}

/// Draws the widgets of a shape's values; a value without a widget stays as it is. A shape is moved by its first place.
struct ShapeWidgets {
  Widgets& w;
  std::optional<glm::dvec3> way{};
  static constexpr float min_size = 0.02f, max_size = 10, max_coordinate = session::max_solid_coordinate;  // m

  void operator()(const char*, softbody::solid::Place p) {
    if (way) {
      p.value += *way;
      return;
    }
    const glm::dvec3 before = p.value;
    w.row_label("Position", w.px(label_column));
    w.drag("Solid position", p.value, -max_coordinate, max_coordinate, "x, y and z in metres.");
    way = p.value - before;
  }
  void operator()(const char* key, softbody::solid::Length l) {
    std::string text(key);
    const std::string label = "Solid " + text;
    text[0] = static_cast<char>(std::toupper(key[0]));
    w.row_label(text, w.px(label_column));
    w.slider(label, l.value, min_size, max_size, "%.2f m", text + " of the solid.", true);
  }
  void operator()(const char*, softbody::solid::Height h) {
    w.row_label("Height", w.px(label_column));
    w.slider("Ground height", h.value, -3, 3, "%.2f m", "Height of the ground.");
  }
  void operator()(const char*, softbody::solid::HalfSize s) {
    glm::dvec3 size = 2.0 * s.value;
    w.row_label("Size", w.px(label_column));
    w.drag("Solid size", size, min_size, max_coordinate, "Size along the axes of the box, in metres.");
    s.value = 0.5 * size;
  }
  void operator()(const char*, auto) {}
};

}  // namespace

void draw_solids(Widgets& w, const Session& session, const UiState& ui) {
  const std::vector<softbody::Solid>& solids = session.world().scene().solids;
  if (solids.empty()) {
    ImGui::TextDisabled("The scene has no solids.");
    return;
  }
  const std::vector<std::size_t> order = session::listed(solids);
  const auto shown = static_cast<std::size_t>(std::ranges::find(order, ui.solid.value_or(order[0])) - order.begin());
  const std::size_t chosen = choose(w, "Solid", "The solid to edit.", shown, order.size(),
                                    [&](std::size_t i) { return session::solid_name(solids, order[i]); });
  if (ui.scrolls_to_solid) {
    ImGui::SetScrollHereY(0);
    w.ask([](UiState& state) { state.scrolls_to_solid = false; });
  }
  const std::size_t index = order[chosen];
  if (chosen != shown) w.ask([index](UiState& state) { state.solid = index; });
  softbody::Solid solid = solids[index];
  if (w.checkbox("Enabled###Solid enabled", solid.enabled, "Bodies pass through a solid that is not enabled."))
    solid.enabled = !solid.enabled;
  ImGui::BeginDisabled(!solid.enabled);
  solid.values(ShapeWidgets{w});
  w.row_label("Friction", w.px(label_column));
  w.slider("Solid friction", solid.friction, 0, 2, "%.2f", "Coefficient of friction.");
  w.row_label("Restitution", w.px(label_column));
  w.slider(
      "Solid restitution", solid.restitution, 0, 1, "%.2f",
      "Bounce of bodies off the solid. At 0 contact keeps the energy that it takes in an impact, at 1 it gives all "
      "back.");
  ImGui::EndDisabled();
  if (solid != solids[index]) w.ask([index, solid](Session& s) { s.settings.set_solid(index, solid); });
}

void draw_world(Widgets& w, const Session& session, const UiState& ui) {
  draw_values(w, session, ValuePlace::world);
  ImGui::Separator();
  draw_material(w, session, ui);
  if (w.button("Restore world", "Restores gravity, materials and solids of the scene file.",
               ImGui::GetContentRegionAvail().x))
    w.ask([](Session& s) { s.settings.restore_world(); });
}

}  // namespace app::ui
