#include "app/session/undo_history.h"

#include <cassert>
#include <utility>

namespace app::session {

void UndoHistory::push(PastWorld past) {
  past_.push_back(std::move(past));
  while (past_.size() > max_count || (past_.size() > 1 && bytes() > limit_)) past_.erase(past_.begin());
}

PastWorld& UndoHistory::last() {
  assert(!empty());
  return past_.back();
}

void UndoHistory::pop() {
  assert(!empty());
  past_.pop_back();
}

std::size_t UndoHistory::bytes() const {
  std::size_t sum = 0;
  for (const PastWorld& past : past_) sum += past.snapshot.bytes();
  return sum;
}

}  // namespace app::session
