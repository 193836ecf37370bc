#pragma once
// What the user sets: gravity, materials and solids; the integrator; the detector and its settings.

#include "app/compare/method_style.h"
#include "app/session/simulation.h"
#include "app/session/solid_list.h"

namespace app::session {

/// A setting that is refused changes nothing, and the notice says why.
class SettingControls {
 public:
  explicit SettingControls(Simulation& simulation) : simulation_(simulation) {}

  /// In m/s^2, along the gravity of the scene; downwards if it has none.
  void set_gravity(double strength);
  void set_material(std::size_t index, const softbody::Material& material);
  const SolidList& solids() const { return simulation_.world().scene().solids; }
  void set_solids(const SolidList& solids);
  /// From here to Simulation::end_drag(), undo() takes all that set_solids() does as one change: `solid` is moved.
  void begin_drag(std::size_t solid);
  /// Gravity, materials and solids as the scene has them.
  void restore_world();

  void set_integrator(const softbody::IntegratorChoice& choice);

  void set_method(std::string_view key);
  /// The next of these methods, which are the first ones of collide::method_table(), that the window can afford.
  void next_method(const compare::MethodSet& methods);
  void set_contact_surface(softbody::ContactSurface surface);
  void next_contact_surface();
  void set_collision(const collide::Settings& settings, bool default_cell_size);
  /// Method, settings and contact surface as the scene has them.
  void restore_detection();

 private:
  bool affordable(const collide::Method& method, const collide::Settings& settings);

  Simulation& simulation_;
};

}  // namespace app::session
