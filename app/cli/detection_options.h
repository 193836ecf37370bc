#pragma once
// The options of detection, which the demo, `simulate` and `detect` share.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "collide/methods.h"

namespace CLI {
class App;
}

namespace app {

/// What the command line says about detection; what it leaves open stays as the scene or the default has it.
struct DetectionOptions {
  std::optional<std::string> method;
  std::optional<int> levels;
  std::optional<std::uint32_t> buckets;
  std::optional<std::string> cell_size;  // "S", "X,Y,Z" in metres or "auto", as typed
  std::optional<double> tolerance;       // m
  std::optional<std::string> primes;     // "A,B,C", as typed
};

/// Offers them on the command line.
void add_detection_options(CLI::App& command, DetectionOptions& options);

/// The method asked for, or else the one with the key `otherwise`. Throws UsageError if there is no such method.
const collide::Method& chosen_method(const DetectionOptions& options, std::string_view otherwise);

/// Whether it says that the cell size is to be worked out, or nothing for the default.
bool automatic_cell_size(const DetectionOptions& options, bool otherwise);

/// Puts all the others into `settings`, which must be usable. Throws UsageError that names the option at fault.
void apply(const DetectionOptions& options, collide::Settings& settings);

/// A line for each setting that is allowed but spoils something of this method: now those of the hash, if it has one.
std::vector<std::string> warnings(const collide::Method& method, const collide::Settings& settings);

}  // namespace app
