// The panel's section on gravity, materials and solids, which can be changed while the world runs.

#include <algorithm>
#include <cassert>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "softbody/forces/material_keys.h"

namespace app::ui {
namespace {

/// Draws a list of `count` items (at least one) and returns the chosen index.
template <class Name>
std::size_t choose(Widgets& w, const char* label, const char* tooltip, std::size_t chosen, std::size_t count,
                   const Name& name) {
  assert(count > 0);
  chosen = std::min(chosen, count - 1);
  w.row_label(label, w.px(label_column));
  if (!w.begin_combo(label, name(chosen).c_str(), tooltip)) return chosen;
  for (std::size_t i = 0; i < count; ++i)
    if (w.combo_item(name(i).c_str(), i == chosen, nullptr)) chosen = i;
  ImGui::EndCombo();
  return chosen;
}

void set_material(Session& session, std::size_t index, std::string_view what, const softbody::Material& material) {
  session.simulation.change_scene(fmt::format("{} of {}", what, material.name),
                                  [&](softbody::Scene& scene) { scene.materials[index] = material; });
}

/// Offers the presets for a material of the scene, which keeps its name.
void draw_preset(Widgets& w, Session& session, std::size_t index) {
  const softbody::Material now = session.world().scene().materials[index];
  softbody::Material chosen = now;
  const auto renamed = [&](softbody::Material preset) {
    preset.name = now.name;
    constexpr const softbody::Key& key = softbody::Material::start_in_equilibrium;
    preset[key] = now[key];
    return preset;
  };
  const auto& presets = session.scenes.presets();
  const auto same = std::ranges::find(presets, now, renamed);
  w.row_label("Preset", w.px(label_column));
  if (!w.begin_combo("Material preset", same == presets.end() ? "Custom" : same->name.c_str(),
                     "Sets all values below to those of a known material."))
    return;
  for (const softbody::Material& preset : presets)
    if (w.combo_item(preset.name.c_str(), renamed(preset) == now, nullptr)) chosen = renamed(preset);
  ImGui::EndCombo();
  set_material(session, index, "Preset", chosen);
}

void draw_material(Widgets& w, Session& session, UiState& ui) {
  const std::vector<softbody::Material>& all = session.world().scene().materials;
  ui.material = choose(w, "Material", "The material to edit.", ui.material, all.size(), [&](std::size_t i) {
    return all[i].name.empty() ? "material " + std::to_string(i + 1) : all[i].name;
  });
  draw_preset(w, session, ui.material);
  for (const softbody::Key* key : softbody::material_keys()) {
    const softbody::Slider& s = key->slider;
    if (!s.text) continue;
    softbody::Material changed = session.world().scene().materials[ui.material];
    double shown = changed[*key] / s.unit;
    w.row_label(s.text, w.px(label_column));
    if (!w.slider(std::string(key->name).c_str(), shown, s.least, s.most, s.format, std::string(key->summary).c_str(),
                  s.logarithmic))
      continue;
    changed[*key] = shown * s.unit;
    set_material(session, ui.material, s.text, changed);
  }
}

constexpr float max_coordinate = 20, min_size = 0.02f, max_size = 10;  // m

bool drag_position(Widgets& w, glm::dvec3& position) {
  w.row_label("Position", w.px(label_column));
  return w.drag("Solid position", position, -max_coordinate, max_coordinate, "x, y and z in metres.");
}

bool slide_radius(Widgets& w, double& radius) {
  w.row_label("Radius", w.px(label_column));
  return w.slider("Solid radius", radius, min_size, max_size, "%.2f m", "Radius of the solid.", true);
}

// These draw where a solid is and how large; true if that changed.
bool draw_shape(Widgets& w, softbody::Ground& ground) {
  w.row_label("Height", w.px(label_column));
  return w.slider("Ground height", ground.height, -3, 3, "%.2f m", "Height of the ground.", false);
}
bool draw_shape(Widgets& w, softbody::SolidSphere& s) {
  const bool moved = drag_position(w, s.centre);
  return slide_radius(w, s.radius) || moved;
}
bool draw_shape(Widgets& w, softbody::SolidPlane& p) { return drag_position(w, p.point); }
bool draw_shape(Widgets& w, softbody::SolidBox& b) {
  glm::dvec3 size = 2.0 * b.half_size;
  const bool moved = drag_position(w, b.centre);
  w.row_label("Size", w.px(label_column));
  const bool resized =
      w.drag("Solid size", size, min_size, max_coordinate, "Size along the axes of the box, in metres.");
  if (resized) b.half_size = 0.5 * size;
  return moved || resized;
}
bool draw_shape(Widgets& w, softbody::SolidCapsule& c) {
  glm::dvec3 from = c.from;
  const bool moved = drag_position(w, from);
  c.to += from - c.from;
  c.from = from;
  return slide_radius(w, c.radius) || moved;
}

template <class Solid>
bool draw_solid(Widgets& w, Solid& solid) {
  bool changed = draw_shape(w, solid);
  const auto slide = [&](const char* text, const char* label, double& value, double max, const char* tooltip) {
    w.row_label(text, w.px(label_column));
    changed |= w.slider(label, value, 0, max, "%.2f", tooltip, false);
  };
  slide("Friction", "Solid friction", solid.friction, 2, "Coefficient of friction.");
  slide("Restitution", "Solid restitution", solid.restitution, 1,
        "Bounce of bodies off the solid. At 0 contact keeps the energy that it takes in an impact, at 1 it gives all "
        "back.");
  return changed;
}

void draw_solids(Widgets& w, Session& session, UiState& ui) {
  if (session.settings.solids().empty()) {
    ImGui::TextDisabled("The scene has no solids.");
    return;
  }
  session::SolidList list = session.settings.solids();
  ui.solid = choose(w, "Solid", "The solid to edit.", ui.solid, list.size(),
                    [&](std::size_t i) { return session::solid_name(list, i); });
  session::SolidEntry& entry = list[ui.solid];
  bool changed = w.checkbox("Enabled###Solid enabled", entry.on, "Bodies pass through a solid that is not enabled.");
  ImGui::BeginDisabled(!entry.on);
  changed |= std::visit([&](auto& solid) { return draw_solid(w, solid); }, entry.solid);
  ImGui::EndDisabled();
  if (changed) session.settings.set_solids(list);
}

}  // namespace

void draw_world(Widgets& w, Session& session, UiState& ui) {
  draw_values(w, session, ui, false);
  ImGui::Separator();
  draw_material(w, session, ui);
  ImGui::Separator();
  draw_solids(w, session, ui);
  if (w.button("Restore world", "Restores gravity, materials and solids of the scene file.",
               ImGui::GetContentRegionAvail().x))
    session.settings.restore_world();
}

}  // namespace app::ui
