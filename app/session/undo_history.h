#pragma once
// The past of the demo that undo() returns to, within a bound of memory.

#include <cstddef>
#include <vector>

#include "app/session/scene_file.h"
#include "app/session/solid_list.h"
#include "softbody/snapshot.h"

namespace app::session {

/// The scene as it was loaded, with the materials that added bodies brought.
struct LoadedScene {
  softbody::Scene scene;
  SceneFile file;    // where the scene came from, or was saved to last
  SolidList solids;  // in use, also those that are switched off
};

/// The world before a change, and its scene.
struct PastWorld {
  softbody::Snapshot snapshot;
  LoadedScene loaded;
  bool left = false;  // for another world; else its bodies were changed
};

class UndoHistory {
 public:
  static constexpr std::size_t max_count = 8, max_bytes = std::size_t{64} << 20;

  explicit UndoHistory(std::size_t limit = max_bytes) : limit_(limit) {}

  bool empty() const { return past_.empty(); }
  std::size_t count() const { return past_.size(); }
  /// Keeps a past; forgets the oldest beyond the bounds, but never the last one.
  void push(PastWorld past);
  /// Returns the latest. Precondition: not empty.
  PastWorld& last();
  void pop();
  /// Returns the memory of the snapshots in bytes.
  std::size_t bytes() const;

 private:
  std::size_t limit_;
  std::vector<PastWorld> past_;  // the latest last
};

}  // namespace app::session
