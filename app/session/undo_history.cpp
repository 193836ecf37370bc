#include "app/session/undo_history.h"

#include <cassert>
#include <utility>

namespace app::session {

void UndoHistory::push(KeptWorld before) {
  worlds(Way::forward).clear();
  keep(Way::back, std::move(before));
}

const KeptWorld& UndoHistory::next(Way way) const {
  assert(!empty(way));
  return worlds(way).back();
}

void UndoHistory::turn(Way way, KeptWorld present) {
  assert(!empty(way));
  worlds(way).pop_back();
  keep(opposite(way), std::move(present));
}

void UndoHistory::keep(Way way, KeptWorld world) {
  auto &here = worlds(way), &there = worlds(opposite(way));
  here.push_back(std::move(world));
  while (count() > max_count || (count() > 1 && bytes() > limit_)) {
    auto& longer = here.size() > there.size() ? here : there;
    longer.erase(longer.begin());
  }
}

std::size_t UndoHistory::bytes() const {
  std::size_t sum = 0;
  for (const auto& way : worlds_)
    for (const KeptWorld& kept : way)
      sum += kept.world.index() == 0 ? std::get<0>(kept.world).bytes() : std::get<1>(kept.world)->bytes();
  return sum;
}

}  // namespace app::session
