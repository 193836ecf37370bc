#include "app/session/setting_controls.h"

#include <algorithm>
#include <cassert>

#include "softbody/scene/scene_keys.h"

namespace app::session {

using softbody::Scene;

void SettingControls::set_solid(std::size_t index, const softbody::Solid& solid) {
  const std::vector<softbody::Solid>& solids = simulation_.world().scene().solids;
  assert(index < solids.size());
  if (solid == solids[index]) return;
  simulation_.change_scene("change of " + solid_name(solids, index),
                           [&](Scene& scene) { scene.solids[index] = solid; });
}

void SettingControls::set_integrator(const softbody::IntegratorChoice& choice) {
  if (simulation_.simulated()) simulation_.set_integrator(choice);
}

bool SettingControls::set_method(std::string_view key) {
  return simulation_.change_scene("Method", [key](Scene& scene) { scene.method = key; });
}

void SettingControls::next_method(const compare::MethodSet& methods) {
  const auto all = collide::method_table().first(methods.size());
  const auto here = std::ranges::find(all, edited(simulation_).method().key, &collide::Method::key);
  const auto first = static_cast<std::size_t>(here - all.begin());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const std::size_t next = (first + i) % all.size();
    if (methods[next] && all[next].can_drive() && set_method(all[next].key)) return;
  }
}

void SettingControls::next_contact_surface() {
  simulation_.change_scene("Contact", [](Scene& scene) {
    const auto& all = softbody::contact_surfaces;
    const auto here = std::ranges::find(all, scene.contact_surface, &softbody::ContactSurfaceInfo::value);
    scene.contact_surface = all[static_cast<std::size_t>(here + 1 - all.begin()) % all.size()].value;
  });
}

void SettingControls::restore_world() {
  const Scene& loaded = simulation_.loaded.scene;
  const auto restore = [&](Scene& scene) {
    softbody::copy_values(loaded, scene, false);
    std::copy_n(loaded.materials.begin(), std::min(loaded.materials.size(), scene.materials.size()),
                scene.materials.begin());
    scene.solids = loaded.solids;
  };
  simulation_.change_scene("Restore world", restore);
}

void SettingControls::restore_detection() {
  simulation_.change_scene("Restore settings",
                           [this](Scene& scene) { softbody::copy_values(simulation_.loaded.scene, scene, true); });
}

}  // namespace app::session
