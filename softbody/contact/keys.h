#pragma once
// The keys of a material that concern contact.

#include <array>

#include "softbody/model/key.h"

namespace softbody::contact {

inline constexpr auto rebound_speed =
    Key("rebound_speed", "m/s", 0, {0, 1e6},
        "Without restitution, solids throw a body back hardly faster than this. 0: no limit. Restitution gives back "
        "what this takes.",
        {"Rebound", "%.1f m/s", 0, 10}, {.place = 21});
inline constexpr auto friction = Key("friction", "", 0.5, {0, 10}, "Coefficient of friction against other bodies.",
                                     {"Friction", "%.2f", 0, 2}, {.place = 23});
inline constexpr auto restitution =
    Key("restitution", "", 0, {0, 1},
        "Bounce off solids and other bodies. The larger restitution of the two sides counts. Its square is the share "
        "of the energy taken by contact in an impact that contact gives back.",
        {"Restitution", "%.2f", 0, 1}, {.place = 24});
inline constexpr auto rolling_resistance =
    Key("rolling_resistance", "", 0.02, {0, 10},
        "Coefficient of rolling resistance on solids: the torque over the radius times the normal force.",
        {"Rolling", "%.2f", 0, 1}, {.place = 25});
inline constexpr auto stiffness =
    Key("contact_stiffness", "N/m", 100, {0, 1e9},
        "Stiffness of vertex-vertex contact (§2.3), shared among the contacts of a vertex.",
        {"Contact", "%.0f N/m", 1, 1000, true}, {.place = 30});
inline constexpr std::array keys{&rebound_speed, &friction, &restitution, &rolling_resistance, &stiffness};

}  // namespace softbody::contact
