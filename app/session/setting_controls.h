#pragma once
// Settings that are more than a value of the scene: solids, the integrator, the next of a list, those of the file.

#include "app/compare/method_style.h"
#include "app/session/simulation.h"
#include "app/session/solid_list.h"

namespace app::session {

/// A setting that is refused changes nothing, and the notice says why.
class SettingControls {
 public:
  explicit SettingControls(Simulation& simulation) : simulation_(simulation) {}

  /// index: in the scene.
  void set_solid(std::size_t index, const softbody::Solid& solid);
  void set_integrator(const softbody::IntegratorChoice& choice);
  bool set_method(std::string_view key);
  /// The next of these methods, which are the first ones of collide::method_table(), that the window can afford.
  void next_method(const compare::MethodSet& methods);
  void next_contact_surface();
  /// Gravity, materials and solids as the scene has them.
  void restore_world();
  /// Method, settings and contact surface as the scene has them.
  void restore_detection();

 private:
  Simulation& simulation_;
};

}  // namespace app::session
