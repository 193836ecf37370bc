#pragma once
// States for `detect`, and an oracle that knows only the contract of the program.

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {

struct Body {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::vector<unsigned>> faces;  // local, from 0
};

/// All bodies of one frame.
struct State {
  std::vector<Body> bodies;
  /// Returns an OBJ file, with the first body before the first `o`.
  std::string obj() const;
};

/// A line of the contacts file, as found or as expected.
struct ContactRow {
  unsigned frame, vertex_a, vertex_b, body_a, body_b;
  float distance;
  auto operator<=>(const ContactRow&) const = default;
};

struct Rules {
  float tolerance;
  bool self = true;
  const State* edges = nullptr;  // whose faces count; nullptr: the state's own
  const State* rest = nullptr;
};

/// Returns the contacts, by a plain double loop over all pairs.
std::vector<ContactRow> oracle(unsigned frame, const State& state, const Rules& rules);

/// Returns crumpled, overlapping grids of mixed sizes, a body of one vertex and an empty body.
State random_state(unsigned seed);
/// Returns the same bodies without faces, each vertex moved by up to `max` along each axis.
State moved(const State& state, float max, unsigned seed);

/// Reads a contacts file. Fails the test if it is not of the contract's form.
std::vector<ContactRow> read_contacts(const std::filesystem::path& file);

/// A folder with files for `detect`.
class DetectFolder : public testing::Test {
 protected:
  std::string file(const std::string& name, const State& state) const { return folder.write(name, state.obj()); }
  /// Returns the contacts that `detect` writes. Each call replaces those of the one before.
  std::vector<ContactRow> contacts(const Words& arguments) {
    const std::string csv = folder.path() / "contacts.csv";
    figures = detect(with(arguments, {"--contacts", csv}));
    return read_contacts(csv);
  }

  TemporaryFolder folder;
  nlohmann::json figures;  // what the last contacts() printed
};

}  // namespace cli::test
