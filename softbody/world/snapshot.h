#pragma once
// Snapshots of a world, to which it can return.

#include <memory>
#include <optional>

#include "softbody/forces/grab.h"

namespace softbody {

/// State of a world at one instant, made by World::snapshot(). It shares meshes and materials with the world. Copies of
/// a snapshot share everything.
struct Snapshot {
  /// All other values that decide how the world goes on.
  struct Values;

  int frame = 0;
  std::optional<Grab> grab;  // reset it to continue without the hand
  std::shared_ptr<const Values> values;

  /// Returns the memory of the snapshot in bytes, up to a few kilobytes, without what it shares with the world.
  std::size_t bytes() const;
};

}  // namespace softbody
