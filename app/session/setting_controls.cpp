#include "app/session/setting_controls.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "app/session/window_work.h"

namespace app::session {

using softbody::World;

void SettingControls::set_gravity(double strength) {
  const glm::dvec3 gravity = simulation_.loaded.scene.gravity;
  const double length = glm::length(gravity);
  const glm::dvec3 direction = length > 0 ? gravity / length : glm::dvec3(0, -1, 0);
  simulation_.change([&](World& world) { world.set_gravity(strength * direction); });
}

void SettingControls::set_material(std::size_t index, const softbody::Material& material) {
  simulation_.change([&](World& world) { world.set_material(index, material); });
}

void SettingControls::set_solids(const SolidList& solids) {
  softbody::Scene scene;
  scene.solids = solids;
  simulation_.keep_drag();
  simulation_.change([&](World& world) { world.set_solids(scene); });
}

void SettingControls::restore_world() {
  const softbody::Scene& scene = simulation_.loaded.scene;
  simulation_.change([&](World& world) {
    world.set_gravity(scene.gravity);
    world.set_solids(scene);
    for (std::size_t i = 0; i < world.scene().materials.size(); ++i) world.set_material(i, scene.materials[i]);
  });
}

void SettingControls::begin_drag(std::size_t solid) {
  simulation_.begin_drag({Change::Of::solids, "move of " + solid_name(solids(), solid)});
}

void SettingControls::set_integrator(const softbody::IntegratorChoice& choice) {
  const World* world = simulation_.simulated();
  if (!world || choice == world->integrator_choice()) return;
  simulation_.change([&](World& changed) { changed.set_integrator(choice); });
}

/// Returns false, with a notice, if the method would hold the window up: it runs where the bodies are moved and drawn.
bool SettingControls::affordable(const collide::Method& method, const collide::Settings& settings) {
  const compare::WorkEstimate work = window_work(simulation_.world(), method, settings);
  if (work.cost() <= max_window_work) return true;
  simulation_.notice.set(method.name + " would take " + work.in_words() +
                         " a frame here: too long to drive the bodies with");
  return false;
}

void SettingControls::set_method(std::string_view key) {
  const collide::Method* method = collide::find_method(key);
  const softbody::BodiesInMotion& world = simulation_.world();
  if (!method || key == world.method().key || !affordable(*method, world.collision())) return;
  simulation_.change_detection([key](auto& changed) { changed.set_method(key); });
}

void SettingControls::next_method(const compare::MethodSet& methods) {
  const auto all = collide::method_table().first(methods.size());
  const softbody::BodiesInMotion& world = simulation_.world();
  const auto here = std::ranges::find(all, world.method().key, &collide::Method::key);
  const auto first = static_cast<std::size_t>(here - all.begin());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const std::size_t next = (first + i) % all.size();
    if (methods[next] && affordable(all[next], world.collision())) return set_method(all[next].key);
  }
}

void SettingControls::set_contact_surface(softbody::ContactSurface surface) {
  if (surface == simulation_.world().scene().contact_surface) return;
  simulation_.change([surface](World& world) { world.set_contact_surface(surface); });
}

void SettingControls::next_contact_surface() {
  const auto& all = softbody::contact_surfaces;
  const auto here =
      std::ranges::find(all, simulation_.world().scene().contact_surface, &softbody::ContactSurfaceInfo::value) -
      all.begin();
  set_contact_surface(all[(static_cast<std::size_t>(here) + 1) % all.size()].value);
}

void SettingControls::set_collision(const collide::Settings& settings, bool default_cell_size) {
  const softbody::BodiesInMotion& world = simulation_.world();
  // The automatic cell size is the world's own business, so a bad one of the caller's does no harm.
  collide::Settings checked = settings;
  if (default_cell_size) checked.cell_size = world.collision().cell_size;
  if (std::string problem = collide::problem(checked); !problem.empty())
    return simulation_.notice.set(std::move(problem));
  if (!affordable(world.method(), checked)) return;
  simulation_.change_detection([&](auto& changed) { changed.set_collision(checked, default_cell_size); });
}

void SettingControls::restore_detection() {
  const softbody::Scene& scene = simulation_.loaded.scene;
  set_contact_surface(scene.contact_surface);
  set_method(scene.method);
  set_collision(scene.collision, scene.default_cell_size);
  set_method(scene.method);  // again: it may have been too slow with the settings before
}

}  // namespace app::session
