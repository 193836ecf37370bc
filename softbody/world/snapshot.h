#pragma once
// A world at an instant, to go back to.

#include <memory>
#include <optional>

#include "softbody/forces/grab.h"

namespace softbody {

/// Made by World::snapshot(). It shares meshes and materials with the world; copies of a snapshot share all of it.
struct Snapshot {
  /// All other values that decide how the world goes on.
  struct Values;

  int frame = 0;
  std::optional<Grab> grab;  // reset it to let the world go on without the hand
  std::shared_ptr<const Values> values;

  /// Returns its memory in bytes, without what is shared with the world; a few kilobytes may be missing.
  std::size_t bytes() const;
};

}  // namespace softbody
