#pragma once
// The worlds that undo and redo go to, within a bound of memory.

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/session/live/beside.h"
#include "app/session/player.h"
#include "app/session/scene_file.h"
#include "softbody/world/snapshot.h"

namespace app::session {

/// The scene as it was loaded, or saved last.
struct LoadedScene {
  softbody::Scene scene;
  SceneFile file;  // where the scene came from, or was saved to last
};

struct KeptPlayer {
  std::shared_ptr<Player> player;
  softbody::Scene scene;  // in use
};

/// The world before or after a change that can be undone.
struct KeptWorld {
  std::variant<softbody::Snapshot, KeptPlayer> world;
  LoadedScene loaded;
  std::string change;   // e.g. "drop of 20 bodies"
  bool leaves = false;  // the change leaves the world for another one
  std::optional<Beside::Kept> beside{};
};

enum class Way { back, forward };  // undo, redo

class UndoHistory {
 public:
  static constexpr std::size_t max_bytes = std::size_t{64} << 20;  // both ways together

  explicit UndoHistory(std::size_t limit = max_bytes) : limit_(limit) {}

  bool empty(Way way) const { return here_ == (way == Way::back ? 0 : steps_.size()); }
  std::size_t count() const { return steps_.size(); }
  /// Keeps the world before a new change; forgets those that could be redone. Beyond the bound it forgets the oldest,
  /// but never this one.
  void push(KeptWorld before);
  /// Returns true if the latest change is of this name, and was not undone or followed by an undone one.
  bool ends_with(const std::string& change) const {
    return empty(Way::forward) && !empty(Way::back) && next(Way::back).change == change;
  }
  /// Returns the world to go to. Precondition: not empty(way).
  const KeptWorld& next(Way way) const;
  /// Takes next(way) out and keeps `present` to come back to; forgets as push() does.
  void turn(Way way, KeptWorld present);
  /// Returns the memory of the worlds in bytes, without what a Player can read again.
  std::size_t bytes() const;

 private:
  void forget(Way kept);

  std::size_t limit_;
  std::vector<KeptWorld> steps_;  // in order: those to go back to, and from here_ on those to go forward to
  std::size_t here_ = 0;
};

}  // namespace app::session
