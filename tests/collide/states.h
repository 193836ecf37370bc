#pragma once
// States that detectors are tried on, and a plain oracle that says what they must find.

#include <functional>
#include <random>
#include <string>

#include "collide/methods.h"

namespace collide::test {

/// Bodies with their positions; owns what a Frame only points to.
struct State {
  std::vector<float> x, y, z;
  Bodies bodies;
  float tolerance = 0.1f;

  Frame frame() const { return {x, y, z, &bodies}; }
  void add(std::shared_ptr<const Shape> shape, const std::vector<glm::vec3>& positions);
  /// A body without edges and without rest positions.
  void add(const std::vector<glm::vec3>& positions);
};

/// An icosphere: 12, 42, 162, ... vertices on a sphere of the radius, and its edges and faces.
struct Ball {
  std::vector<glm::vec3> vertices;
  std::vector<std::array<Index, 2>> edges;
  std::vector<std::array<Index, 3>> faces;  // counter-clockwise seen from outside
};
Ball icosphere(int subdivisions, float radius);
std::vector<glm::vec3> moved(std::vector<glm::vec3> vertices, const glm::vec3& by);
std::vector<glm::vec3> random_points(std::mt19937& random, std::size_t count, float lo, float hi);
float uniform(std::mt19937& random, float lo, float hi);
/// Returns the distance in long double: differences of floats are exact, and no square overflows or underflows.
long double distance(const glm::vec3& a, const glm::vec3& b);

struct NamedState {
  std::string name;
  std::function<State()> make;
};
const std::vector<NamedState>& named_states();

/// Whether all positions of a body are finite.
bool finite(const State& state, Index body);
/// All contacts by the plain double loop, written without the code under test except Shape::excludes.
std::vector<Contact> oracle(const State& state, const Settings& settings);
/// Those of the contacts that lie inside one body.
std::vector<Contact> inside_bodies(const State& state, const std::vector<Contact>& contacts);

/// Returns the default settings with cells of 1 m.
inline Settings metre_cells() { return {.cell_size = glm::vec3(1.0f)}; }

/// Detects once with a fresh detector.
Result detect(std::string_view method, const State& state, const Settings& settings, int threads = 1);

}  // namespace collide::test
