#include "app/session/undo_history.h"

#include <cassert>
#include <utility>

namespace app::session {

void UndoHistory::push(KeptWorld before) {
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(here_), steps_.end());
  steps_.push_back(std::move(before));
  ++here_;
  forget(Way::back);
}

const KeptWorld& UndoHistory::next(Way way) const {
  assert(!empty(way));
  return steps_[way == Way::back ? here_ - 1 : here_];
}

void UndoHistory::turn(Way way, KeptWorld present) {
  assert(!empty(way));
  if (way == Way::back) --here_;
  steps_[here_] = std::move(present);
  if (way == Way::forward) ++here_;
  forget(way == Way::back ? Way::forward : Way::back);
}

/// Forgets the worlds that are the furthest away. kept: the way to the one that was kept last, which stays.
void UndoHistory::forget(Way kept) {
  while (steps_.size() > 1 && bytes() > limit_) {
    const bool back = 2 * here_ + (kept == Way::forward ? 1 : 0) > steps_.size();
    steps_.erase(back ? steps_.begin() : steps_.end() - 1);
    if (back) --here_;
  }
}

std::size_t UndoHistory::bytes() const {
  std::size_t sum = 0;
  for (const KeptWorld& kept : steps_) {
    sum += kept.world.index() == 0 ? std::get<0>(kept.world).bytes() : std::get<1>(kept.world).player->bytes();
    if (kept.beside) sum += kept.beside->world.bytes();
  }
  return sum;
}

}  // namespace app::session
