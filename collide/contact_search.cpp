#include "collide/contact_search.h"

#include <algorithm>
#include <stdexcept>

#include "collide/reach.h"

namespace collide {

void ContactSearch::begin(const Frame& frame, const Settings& settings, const Points& points, int threads) {
  frame_ = &frame;
  points_ = &points;
  tolerance2_ = settings.tolerance * settings.tolerance;
  reach_ = contact_reach(settings.tolerance);
  self_collision_ = settings.self_collision;
  found_ = 0;
  threads_.resize(static_cast<std::size_t>(threads));
  for (Thread& thread : threads_) {
    thread.hits.clear();
    thread.contacts.clear();
    thread.self_contacts = thread.pair_tests = 0;
  }
}

template <class Search>
void ContactSearch::search_rows(Thread& own, const Points& points, Range a, Range b, const Search& search) {
  constexpr Index most_tests = 1u << 20;  // between two looks at the number of contacts
  const Index most_rows = std::max<Index>(1, most_tests / std::max<Index>(1, b.size()));
  for (Range rows{a.begin, a.begin}; rows.begin < a.end; rows.begin = rows.end) {
    rows.end = rows.begin + std::min(most_rows, a.end - rows.begin);
    search(rows);
    if (!own.hits.empty()) keep_contacts(own, points);
  }
}

void ContactSearch::test(int thread, const Points& points, Range a, Range b) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  search_rows(own, points, a, b, [&](Range rows) { near_pairs(points, rows, b, tolerance2_, own.hits); });
  const std::uint64_t na = a.size(), nb = b.size();
  own.pair_tests += na * nb - (a.begin == b.begin ? na * (na + 1) / 2 : 0);
}

void ContactSearch::test_near(int thread, Range a, Range b, const Aabb& region) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  search_rows(own, *points_, a, b, [&](Range rows) {
    const std::uint64_t tested = near_pairs(*points_, rows, b, region, reach_, tolerance2_, own.hits);
    own.pair_tests += tested * b.size();
  });
}

void ContactSearch::keep_contacts(Thread& own, const Points& points) {
  const Bodies& bodies = *frame_->bodies;
  const std::size_t before = own.contacts.size();
  for (const SlotPair& hit : own.hits) {
    const Index a = points.vertex[hit.a], b = points.vertex[hit.b];
    const Index body = points.body[hit.a], first = bodies.first[body];
    const bool self = body == points.body[hit.b];
    if (self && (!self_collision_ || bodies.shape[body]->excludes(a - first, b - first, tolerance2_))) continue;
    own.self_contacts += self;
    own.contacts.push_back({std::min(a, b), std::max(a, b)});
  }
  own.hits.clear();
  const std::size_t added = own.contacts.size() - before;
  if (found_.fetch_add(added, std::memory_order_relaxed) + added > max_contacts) {
    throw std::length_error("more than 134217728 contacts in one frame: lower the tolerance");
  }
}

void ContactSearch::finish(Result& result) {
  for (const Thread& thread : threads_) {
    result.contacts.insert(result.contacts.end(), thread.contacts.begin(), thread.contacts.end());
    result.self_contacts += thread.self_contacts;
    result.counters.pair_tests += thread.pair_tests;
  }
  std::sort(result.contacts.begin(), result.contacts.end());
}

}  // namespace collide
