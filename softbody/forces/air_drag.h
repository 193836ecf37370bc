#pragma once
// The drag of the air, linear in the speed against it: -c (v - wind) on a body, shared by its particles. The part c
// wind is the same everywhere and always, so it acts as gravity does: see uniform_acceleration().

#include <optional>
#include <string_view>

#include "softbody/forces/coordinates.h"
#include "softbody/model/body_model.h"

namespace softbody {

struct AirDrag {
  static constexpr std::string_view key = "air-drag";
  static constexpr auto drag =
      Key("air_drag", "kg/s", 0, {0, 1e9}, "Drag of the air on a body: the force over its speed against the wind.", {},
          {.place = 12});
  static constexpr std::array keys{&drag};
  static constexpr bool internal = false;
  static constexpr auto coordinate = Coordinate::path;
  static constexpr const char* absent = "no material has air drag";

  struct Data {
    double damping;  // N s/m, of a particle
  };
  static std::optional<Data> make(const BodyModel& model, const MeshSource&) {
    const double all = model.material[drag];
    if (all <= 0) return {};
    return Data{all / double(model.mesh.vertices.size())};
  }
};

}  // namespace softbody
