#pragma once
// Keeps snapshots of a world's past within a bound of memory: dense in the recent past, sparse further back.

#include <vector>

#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"

namespace app::session {

class Rewind {
 public:
  static constexpr std::size_t max_bytes = std::size_t{64} << 20;
  static constexpr int period = 5;  // min frames between two snapshots, except before the newest

  explicit Rewind(std::size_t limit = max_bytes) : limit_(limit) {}

  /// Keeps the present world as the newest snapshot. Removes those of this frame and of later ones: they belong to
  /// another future.
  void keep(const softbody::World& world);

  /// Returns the snapshots, ascending by frame.
  const std::vector<softbody::Snapshot>& snapshots() const { return snapshots_; }
  /// Returns the index of the last snapshot not after this frame; 0 if all are later. Precondition: there is a
  /// snapshot.
  std::size_t at(int frame) const;
  std::size_t bytes() const { return bytes_; }

 private:
  void remove(std::size_t i);
  std::size_t most_redundant() const;

  std::size_t limit_, bytes_ = 0;
  std::vector<softbody::Snapshot> snapshots_;
};

}  // namespace app::session
