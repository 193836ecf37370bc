#pragma once

namespace softbody {

/// m, of a scene's tolerance and cell sides.
inline constexpr double min_length = 1e-9, max_length = 1e6;

/// Of a scene: the tolerance in m, and gravity along each axis in m/s^2. With more, steps of light bodies would not
/// stay finite.
inline constexpr double max_tolerance = 10, max_gravity = 1e3;

}  // namespace softbody
