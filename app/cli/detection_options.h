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

namespace app::cli {

/// The options of detection. For an option that is not given, the scene or the default decides.
struct DetectionOptions {
  std::optional<std::string> method;
  std::optional<int> levels;
  std::optional<std::uint32_t> buckets;
  std::optional<std::string> cell_size;  // "S", "X,Y,Z" in metres or "auto", as typed
  std::optional<double> tolerance;       // m
  std::optional<std::string> primes;     // "A,B,C", as typed
};

/// Adds these options to a command.
void add_detection_options(CLI::App& command, DetectionOptions& options);

/// Returns the chosen method, or the one with the key `otherwise`. Throws UsageError if there is no such method.
const collide::Method& chosen_method(const DetectionOptions& options, std::string_view otherwise);

/// Applies the other options to `settings`. Throws UsageError with the option at fault. Precondition: problem(settings)
/// is empty.
void apply(const DetectionOptions& options, collide::Settings& settings);

/// Returns a line for each setting that is allowed but spoils this method: today those of the hash, if it has one.
std::vector<std::string> warnings(const collide::Method& method, const collide::Settings& settings);

}  // namespace app::cli
