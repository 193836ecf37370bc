#include "app/session/stability/rewind.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace app::session {

void Rewind::keep(const softbody::World& world) {
  while (!snapshots_.empty() && snapshots_.back().frame >= world.frame()) remove(snapshots_.size() - 1);
  // The newest snapshot is replaced unless it is a period after the one before it.
  if (const std::size_t n = snapshots_.size(); n >= 2 && snapshots_[n - 1].frame - snapshots_[n - 2].frame < period)
    remove(n - 1);
  snapshots_.push_back(world.snapshot());
  bytes_ += snapshots_.back().bytes();
  while (bytes_ > limit_ && snapshots_.size() > 1) remove(most_redundant());
}

void Rewind::remove(std::size_t i) {
  bytes_ -= snapshots_[i].bytes();
  snapshots_.erase(snapshots_.begin() + static_cast<std::ptrdiff_t>(i));
}

/// Returns the snapshot whose removal leaves the smallest gap relative to its age, so that gaps grow with age. It is
/// never the newest, and the first only if nothing else is left.
std::size_t Rewind::most_redundant() const {
  std::size_t found = 0;
  double smallest = std::numeric_limits<double>::infinity();
  const int now = snapshots_.back().frame;
  for (std::size_t i = 1; i + 1 < snapshots_.size(); ++i) {
    const double gap = snapshots_[i + 1].frame - snapshots_[i - 1].frame, age = now - snapshots_[i].frame;
    if (gap / age >= smallest) continue;
    smallest = gap / age;
    found = i;
  }
  return found;
}

std::size_t Rewind::at(int frame) const {
  assert(!snapshots_.empty());
  const auto after = std::ranges::upper_bound(snapshots_, frame, {}, &softbody::Snapshot::frame);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - snapshots_.begin(), 1) - 1);
}

}  // namespace app::session
