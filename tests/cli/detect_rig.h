#pragma once
// States for `detect`, and an oracle that knows nothing of the program but its contract.

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/process.h"

namespace cli::test {

struct Body {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::vector<unsigned>> faces;  // local, from 0
};

/// All bodies of one frame.
struct State {
  std::vector<Body> bodies;
  /// As an OBJ file, with the first body before the first `o`.
  std::string obj() const;
};

/// A line of the contacts file, or what it should be.
struct Row {
  unsigned frame, vertex_a, vertex_b, body_a, body_b;
  float distance;
  auto operator<=>(const Row&) const = default;
};

struct Rules {
  float tolerance;
  bool self = true;
  const State* edges = nullptr;  // whose faces count; nullptr: the state's own
  const State* rest = nullptr;
};

/// All pairs in a plain double loop.
std::vector<Row> oracle(unsigned frame, const State& state, const Rules& rules);

/// Crumpled grids of mixed sizes that overlap, a body of one vertex and an empty one.
State random_state(unsigned seed);
/// The same bodies, each vertex moved by up to `most` along each axis, without faces.
State moved(const State& state, float most, unsigned seed);

/// Reads a contacts file; fails the test where it is not of the contract's form.
std::vector<Row> read_contacts(const std::filesystem::path& file);

}  // namespace cli::test
