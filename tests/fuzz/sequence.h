#pragma once
// What a fuzz input stands for: settings and a few frames, each of which changes a little of the one before it.

#include "bytes.h"

namespace fuzz {

/// How much of everything an input may have: most inputs are small, as these find as much in a tenth of the time.
struct Sizes {
  int bodies;        // at most
  int points;        // of a cloud: fewer than these
  int sides;         // of a lattice: at most
  int subdivisions;  // of a sphere: at most
};
inline constexpr Sizes small_sizes{5, 24, 2, 1}, all_sizes{12, 48, 3, 2};

/// The bodies of one frame, one by one, so that they can come and go.
struct Bodies {
  struct One {
    std::shared_ptr<const collide::Shape> shape;
    std::vector<glm::vec3> positions;
  };
  Sizes sizes = all_sizes;
  std::vector<One> all;

  collide::test::State state(float tolerance) const;
};

/// Usable or not: see collide::problem().
collide::Settings read_settings(Bytes& bytes);
Bodies read_bodies(Bytes& bytes, const Sizes& sizes);

/// The next frame: bodies move, jump, crumple, appear, vanish, lose a coordinate, or stay.
void change(Bodies& bodies, Bytes& bytes);

}  // namespace fuzz
