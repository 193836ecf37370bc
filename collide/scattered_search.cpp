#include "collide/scattered_search.h"

#include <algorithm>

namespace collide {

void ScatteredSearch::begin(ContactSearch& search, const Points& points, int threads) {
  search_ = &search;
  points_ = &points;
  threads_.resize(static_cast<std::size_t>(threads));
  for (Thread& own : threads_) own.copies.resize(most_copies);
}

void ScatteredSearch::start(int thread, Range rows, bool rows_meet_themselves) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  own.rows = rows;
  own.copies.shrink(0);
  own.origins.clear();
  own.tested = 0;
  if (rows.size() > short_run) {
    if (rows_meet_themselves) search_->test(thread, rows, rows);
  } else {
    own.append(*points_, rows);
    if (!rows_meet_themselves) own.tested = rows.size();
  }
}

Index ScatteredSearch::Thread::slot_of(Index copy) const {
  const auto behind = std::upper_bound(origins.begin(), origins.end(), copy,
                                       [](Index sought, const SlotPair& origin) { return sought < origin.a; });
  const SlotPair& origin = *std::prev(behind);
  return origin.b + (copy - origin.a);
}

void ScatteredSearch::test_copies(Thread& own, int thread) {
  if (own.tested == own.copies.size()) return;
  const Index rows = own.rows.size();
  search_->test_copies(thread, own.copies, {0, rows}, {own.tested, own.copies.size()},
                       [&](Index copy) { return own.slot_of(copy); });
  own.tested = rows;
  own.copies.shrink(rows);
  own.origins.resize(1);
}

}  // namespace collide
