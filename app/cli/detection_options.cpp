#include "app/cli/detection_options.h"

#include <limits>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "app/base/parse_numbers.h"
#include "app/cli/add_option.h"
#include "app/cli/options.h"

namespace app::cli {
namespace {

std::array<std::uint32_t, 3> read_primes(const std::string& text) {
  const auto parts = split(text, ',');
  const auto prime = [&](std::size_t axis) {
    const auto number = parts.size() == 3 ? parse_integer(parts[axis]) : std::nullopt;
    if (!number || *number < 1 || *number > std::numeric_limits<std::uint32_t>::max())
      throw UsageError("--primes " + text +
                       ": must be three whole numbers from 1 to 4294967295, e.g. 73856093,19349669,83492791");
    return static_cast<std::uint32_t>(*number);
  };
  return {prime(0), prime(1), prime(2)};
}

std::optional<glm::vec3> read_cell_size(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const auto sides = parse_reals(text, ',');
  if (!sides || (sides->size() != 1 && sides->size() != 3))
    throw UsageError("--cell-size " + text + ": must be a number of metres, three of them as X,Y,Z, or auto");
  return glm::vec3((*sides)[0], (*sides)[sides->size() / 2], sides->back());
}

}  // namespace

void add_detection_options(CLI::App& command, DetectionOptions& options) {
  add(command, "--method", "M", options.method, "detector: a key of `list methods`");
  add(command, "--levels", "N", 0, collide::max_levels, options.levels,
      "subdivision level: each body's box is cut into 2^N boxes");
  add(command, "--buckets", "N", 1, collide::max_buckets, options.buckets, "number of buckets of the hash table");
  add(command, "--cell-size", "S|X,Y,Z|auto", options.cell_size,
      "sides of a grid cell in metres, or auto: as large as the largest subdivided box at rest + the tolerance");
  add(command, "--primes", "A,B,C", options.primes,
      "factors of a cell's x, y and z in the hash function (default: 73856093,19349669,83492791)");
  add(command, "--tolerance", "H", options.tolerance, "collision tolerance in metres");
}

const collide::Method& chosen_method(const DetectionOptions& options, std::string_view otherwise) {
  const collide::Method* method = collide::find_method(options.method ? *options.method : otherwise);
  if (!method) throw UsageError("--method " + *options.method + ": unknown; use one of: " + collide::method_keys());
  return *method;
}

void apply(const DetectionOptions& options, collide::Settings& settings) {
  const auto check = [&](const std::string& option) {
    if (const std::string wrong = collide::problem(settings); !wrong.empty()) throw UsageError(option + ": " + wrong);
  };
  if (options.levels) settings.levels = *options.levels;
  if (options.buckets) settings.buckets = *options.buckets;
  if (options.tolerance) {
    settings.tolerance = static_cast<float>(*options.tolerance);
    check(fmt::format("--tolerance {:.9g}", *options.tolerance));
  }
  if (options.cell_size) settings.cell_size = read_cell_size(*options.cell_size);
  check("--cell-size");
  if (options.primes) settings.primes = read_primes(*options.primes);
}

std::vector<std::string> warnings(const collide::Method& method, const collide::Settings& settings) {
  std::string hash = method.uses_hash ? collide::hash_warning(settings) : "";
  if (hash.empty()) return {};
  return {std::move(hash)};
}

}  // namespace app::cli
