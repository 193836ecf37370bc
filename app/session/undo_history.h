#pragma once
// The worlds that undo and redo go to, within a bound of memory.

#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "app/session/player.h"
#include "app/session/scene_file.h"
#include "softbody/world/snapshot.h"

namespace app::session {

/// The scene as it was loaded, with the materials that added bodies brought.
struct LoadedScene {
  softbody::Scene scene;
  SceneFile file;  // where the scene came from, or was saved to last
};

/// A change that can be undone.
struct Change {
  enum class Of { bodies, solids, scene };  // scene: the world is left for another one
  Of of;
  std::string name;  // e.g. "drop of 20 bodies"
};

/// The world before or after a change, and its scene.
struct KeptWorld {
  std::variant<softbody::Snapshot, std::shared_ptr<Player>> world;
  LoadedScene loaded;
  Change change;
};

enum class Way { back, forward };  // undo, redo
inline Way opposite(Way way) { return way == Way::back ? Way::forward : Way::back; }

class UndoHistory {
 public:
  static constexpr std::size_t max_count = 8, max_bytes = std::size_t{64} << 20;  // both ways together

  explicit UndoHistory(std::size_t limit = max_bytes) : limit_(limit) {}

  bool empty(Way way) const { return worlds(way).empty(); }
  std::size_t count() const { return worlds(Way::back).size() + worlds(Way::forward).size(); }
  /// Keeps the world before a new change; forgets those that could be redone. Beyond the bounds it forgets the oldest,
  /// but never this one.
  void push(KeptWorld before);
  /// Returns the world to go to. Precondition: not empty(way).
  const KeptWorld& next(Way way) const;
  /// Takes next(way) out and keeps `present` to come back to; forgets as push() does.
  void turn(Way way, KeptWorld present);
  /// Returns the memory of the worlds in bytes, without what a Player can read again.
  std::size_t bytes() const;

 private:
  const std::vector<KeptWorld>& worlds(Way way) const { return worlds_[static_cast<std::size_t>(way)]; }
  std::vector<KeptWorld>& worlds(Way way) { return worlds_[static_cast<std::size_t>(way)]; }
  void keep(Way way, KeptWorld world);

  std::size_t limit_;
  std::array<std::vector<KeptWorld>, 2> worlds_;  // by Way; the next one last
};

}  // namespace app::session
