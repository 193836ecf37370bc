#pragma once
// What a fuzz input stands for: settings and a few frames, each of which changes a little of the one before it.

#include "bytes.h"

namespace fuzz {

/// The bodies of one frame, one by one, so that they can come and go.
struct Bodies {
  struct One {
    std::shared_ptr<const collide::Shape> shape;
    std::vector<glm::vec3> positions;
  };
  std::vector<One> all;

  collide::test::State state(float tolerance) const;
};

/// Usable or not: see collide::problem().
collide::Settings read_settings(Bytes& bytes);
Bodies read_bodies(Bytes& bytes);

/// The next frame: bodies move, jump, crumple, appear, vanish, lose a coordinate, or stay.
void change(Bodies& bodies, Bytes& bytes);

}  // namespace fuzz
