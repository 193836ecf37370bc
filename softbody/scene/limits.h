#pragma once

namespace softbody {

/// Limits of a scene's tolerance and cell sides, in m.
inline constexpr double min_length = 1e-9, max_length = 1e6;

/// Largest tolerance of a scene in m, and largest gravity along each axis in m/s^2. With larger values, the steps of
/// light bodies would not stay finite.
inline constexpr double max_tolerance = 10, max_gravity = 1e3;

}  // namespace softbody
