#pragma once
// The past of a world, to go back to: snapshots within a bound of memory, dense lately and sparse long ago.

#include <vector>

#include "softbody/snapshot.h"

namespace app {

class Rewind {
 public:
  static constexpr std::size_t max_bytes = std::size_t{64} << 20;
  static constexpr int period = 5;  // frames between two snapshots, at the least, but for the newest

  explicit Rewind(std::size_t limit = max_bytes) : limit_(limit) {}

  /// Keeps the world as it is now as the newest; what was kept of this frame or of later ones is another future's.
  void keep(const softbody::World& world);
  void clear();

  /// Ascending by frames.
  const std::vector<softbody::Snapshot>& snapshots() const { return snapshots_; }
  /// The last one not after this frame; there must be one at all, and the first stands for what is earlier.
  std::size_t at(int frame) const;
  std::size_t bytes() const { return bytes_; }

 private:
  void remove(std::size_t i);
  std::size_t most_redundant() const;

  std::size_t limit_, bytes_ = 0;
  std::vector<softbody::Snapshot> snapshots_;
};

}  // namespace app
