#pragma once
// The keys of a scene that hold one value each, as those of a material do. A row here, and the member of Scene that it
// stands for, is all that scene files, their limits, the panel and the documents need to know a setting.

#include <string_view>
#include <type_traits>
#include <vector>

#include "softbody/model/key.h"
#include "softbody/scene/scene.h"

namespace softbody {

/// Limits of a scene's tolerance and cell sides, in m.
inline constexpr double min_length = 1e-9, max_length = 1e6;

/// Largest tolerance of a scene in m, and largest gravity along each axis in m/s^2. With larger values, the steps of
/// light bodies would not stay finite.
inline constexpr double max_tolerance = 10, max_gravity = 1e3;

namespace scene_key {

inline constexpr Key gravity("gravity", "m/s\u00b2", {-max_gravity, max_gravity},
                             "Acceleration along x, y and z. On Earth it is 9.81.",
                             {"Gravity", "%.2f m/s\u00b2", 0, 30});
inline constexpr Key wind("air.wind", "m/s", {-1e3, 1e3},
                          "Velocity of the air along x, y and z. It acts on bodies whose material has `air_drag`.");
inline constexpr Key method("collision.method", "", {}, "How contacts are found.", {"Method"});
inline constexpr Key levels("collision.levels", "", {0, collide::max_levels},
                            "Level n cuts the box of a body into 2^n boxes (\u00a72.1; the paper uses 3).",
                            {"Level", nullptr, 0, collide::max_levels});
inline constexpr Key buckets("collision.buckets", "", {1, collide::max_buckets},
                             "The number of buckets of the hash table (\u00a72.2; the paper uses 101 and 1001). If "
                             "there are few, different cells share a bucket (aliasing).",
                             {"Buckets"});
inline constexpr Key primes("collision.primes", "", {1, 4294967295},
                            "The hash function multiplies a cell's x, y and z by these factors (\u00a72.2). If a "
                            "factor is 0 modulo the number of buckets, its axis has no effect.",
                            {"Primes"});
inline constexpr Key cell_size("collision.cell_size", "m", {min_length, max_length},
                               "The sides of a grid cell (\u00a72.2). If they are smaller than a subdivided box, the "
                               "paper's method skips cells.",
                               {"Cell size", "%.3f m", 0.02f, 5, true},
                               {.if_missing = "the largest subdivided box at rest + the tolerance"});
inline constexpr Key contact_surface("collision.contact_surface", "", {}, "What pushes bodies apart.", {"Contact"});
inline constexpr Key tolerance("collision.tolerance", "m", {min_length, max_tolerance},
                               "Vertices closer than this are in contact (\u00a72.3).",
                               {"Tolerance", "%.3f m", 0.005f, 0.5f, true});
inline constexpr Key self_collision("collision.self_collision", "", {0, 1},
                                    "Also finds pairs of vertices of one body (\u00a72.4), except those that an edge "
                                    "joins or that are as close at rest.",
                                    {"Self-collision"}, {.is_switch = true});
inline constexpr Key sleep_speed("sleep.speed", "m/s", {0, 1e3},
                                 "Bodies in touch fall asleep when no particle of theirs is faster.");
inline constexpr Key sleep_frames("sleep.frames", "", {1, 1e6}, "They do so after this many frames.");

}  // namespace scene_key

/// Calls visit(key, value) for each of these keys, with the member of the scene that it stands for.
void for_each_value(auto& scene, auto&& visit) {
  visit(scene_key::gravity, scene.gravity);
  visit(scene_key::wind, scene.wind);
  visit(scene_key::method, scene.method);
  visit(scene_key::levels, scene.collision.levels);
  visit(scene_key::buckets, scene.collision.buckets);
  visit(scene_key::primes, scene.collision.primes);
  visit(scene_key::cell_size, scene.collision.cell_size);
  visit(scene_key::contact_surface, scene.contact_surface);
  visit(scene_key::tolerance, scene.collision.tolerance);
  // The last of its table, since the panel has a button beside it.
  visit(scene_key::self_collision, scene.collision.self_collision);
  visit(scene_key::sleep_speed, scene.sleep.speed);
  visit(scene_key::sleep_frames, scene.sleep.frames);
}

/// Sets the value of a key, which must be of this type.
template <class Value>
void set_value(Scene& scene, const Key& key, const Value& value) {
  for_each_value(scene, [&]<class Its>(const Key& other, Its& its) {
    if constexpr (std::is_same_v<Its, Value>)
      if (&other == &key) its = value;
  });
}

/// True for the keys that say how contacts are found and what they do; the others are the world's.
inline bool is_of_detection(const Key& key) { return key.table() == "collision"; }

/// Gives `to` the values of `from` that are, or are not, of detection.
inline void copy_values(const Scene& from, Scene& to, bool of_detection) {
  for_each_value(from, [&](const Key& key, const auto& value) {
    if (is_of_detection(key) == of_detection) set_value(to, key, value);
  });
}

/// Returns the numbers that a value consists of: none of a choice from a list, or of what is automatic.
template <class Value>
std::vector<double> numbers_of(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>)
    return {double(value)};
  else if constexpr (requires { value.has_value(); })
    return value ? numbers_of(*value) : std::vector<double>();
  else if constexpr (requires { value[2]; } && !std::is_convertible_v<Value, std::string_view>)
    return {double(value[0]), double(value[1]), double(value[2])};
  else
    return {};
}

}  // namespace softbody
