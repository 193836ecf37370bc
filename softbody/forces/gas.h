#pragma once
// Gas in closed bodies.

#include <algorithm>
#include <array>
#include <optional>

#include "softbody/forces/coordinates.h"
#include "softbody/model/body_model.h"

namespace softbody {

/// The law of the gas. The volume v may be zero or negative (an inverted body). T: double or Jet.
struct Gas {
  double amount = 0;       // nRT in J: P = amount / V
  double ambient = 0;      // Pa
  double rest_volume = 0;  // V0 in m^3; below 0.1 V0 the law is continued linearly

  /// Absolute pressure in Pa. It continues linearly, so that flat and inverted bodies recover.
  template <class T>
  T pressure(T v) const {
    const double bend = linear_end();
    if (v >= T(bend)) return T(amount) / v;
    return T(amount / bend) * (T(2) - v / T(bend));
  }
  /// Pressure of the surroundings on the faces, in Pa. It acts on the outer side of the skin, so it changes its sign
  /// between -0.1 V0 and 0.1 V0. Otherwise it would inflate an inverted body with little gas without end.
  template <class T>
  T ambient_pressure(T v) const {
    return T(ambient) * std::clamp(v / T(linear_end()), T(-1), T(1));
  }
  /// Pressure in Pa that pulls the faces inwards: minus the gauge pressure.
  template <class T>
  T pull(T v) const {
    return -(pressure(v) - ambient_pressure(v));
  }
  /// Work done against the surroundings in J, 0 at V0; d/dV = ambient_pressure().
  double ambient_energy(double v) const;
  /// Energy in J, 0 at V0: ambient_energy() minus the work done by the gas; d/dV = pull().
  double stored(double v) const;
  /// Change of the energy in J, to within Simpson's rule: a logarithm has not the same last digits on all processors.
  double stored_change(double from, double to) const;
  double scale() const { return ambient + amount / rest_volume; }  // Pa

 private:
  double linear_end() const { return 0.1 * rest_volume; }
};

/// Returns the gas of a model, or nullptr.
const Gas* gas_of(const BodyModel& model);

struct GasPressure {
  static constexpr std::string_view key = "gas-pressure";
  static constexpr auto inside = Key("gas_pressure", "Pa", 0, {0, 1e9},
                                     "Absolute pressure of the gas in a closed body at the volume V0 of the mesh. It "
                                     "grows as the volume V shrinks: gas_pressure V0 / V.",
                                     {"Gas", "%.1f kPa", 50, 200, false, 1e3});
  static constexpr auto outside =
      Key("ambient_pressure", "Pa", 0, {0, 1e9}, "Absolute pressure outside closed bodies.");
  static constexpr std::array keys{&inside, &outside};
  static constexpr bool internal = true;
  static constexpr auto coordinate = Coordinate::volume;
  static constexpr const char* absent = "no closed body with gas";

  using Data = Gas;
  static std::optional<Gas> make(const BodyModel& model, const MeshSource&);
};

}  // namespace softbody
