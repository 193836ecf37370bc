#include "collide/core/contact_search.h"

#include <algorithm>
#include <cassert>

#include "collide/core/cutoff.h"

namespace collide {

namespace {

/// Calls test(rows) for parts of a run that is tested against so many others, so that the number of contacts is looked
/// at now and then.
template <class Test>
void for_rows(Range a, std::uint64_t others, const Test& test) {
  constexpr std::uint64_t max_tests = 1u << 20;
  const Index max_rows =
      a.size() * others <= max_tests ? a.size() : static_cast<Index>(std::max(max_tests / others, std::uint64_t{1}));
  for (Range rows{a.begin, a.begin}; rows.begin < a.end; rows.begin = rows.end) {
    rows.end = rows.begin + std::min(max_rows, a.end - rows.begin);
    test(rows);
  }
}

}  // namespace

void ContactSearch::begin(const Frame& frame, const Settings& settings, const Points& points, int parts) {
  frame_ = &frame;
  points_ = &points;
  tolerance2_ = settings.tolerance * settings.tolerance;
  cutoff_ = contact_cutoff(settings.tolerance);
  self_collision_ = settings.self_collision;
  found_ = 0;
  threads_.resize(static_cast<std::size_t>(parts));
  for (Thread& thread : threads_) {
    thread.hits.clear();
    thread.contacts.clear();
    thread.self_contacts = thread.pair_tests = 0;
  }
}

void ContactSearch::test(int thread, Range a, Range b) {
  assert((b.begin == a.begin && b.end >= a.end) || b.begin >= a.end);
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  const std::uint64_t na = a.size(), nb = b.size();
  for_rows(a, nb, [&](Range rows) {
    near_pairs(*points_, rows, b, tolerance2_, own.hits);
    keep_contacts(own);
  });
  own.pair_tests += na * nb - (a.begin == b.begin ? na * (na + 1) / 2 : 0);
}

void ContactSearch::test(int thread, Range a, std::span<const Range> runs) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  std::uint64_t columns = 0;
  for (const Range run : runs) columns += run.size();
  for_rows(a, columns, [&](Range rows) {
    near_pairs(*points_, rows, runs, tolerance2_, own.hits);
    keep_contacts(own);
  });
  own.pair_tests += a.size() * columns;
}

void ContactSearch::test(int thread, Range a, Range b, const Aabb& box_of_b) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  for_rows(a, b.size(), [&](Range rows) {
    const std::uint64_t tested = near_pairs(*points_, rows, b, box_of_b, cutoff_, tolerance2_, own.hits);
    keep_contacts(own);
    own.pair_tests += tested * b.size();
  });
}

void ContactSearch::keep_contacts(Thread& own) {
  if (own.hits.empty()) return;
  const Points& points = *points_;
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
  if (found_.fetch_add(added, std::memory_order_relaxed) + added > contact_limit)
    throw_too_many_contacts(contact_limit);
}

void ContactSearch::finish(Result& result) {
  result.contacts.clear();
  for (const Thread& thread : threads_)
    result.contacts.insert(result.contacts.end(), thread.contacts.begin(), thread.contacts.end());
  sort_.sort(result.contacts, {0, frame_->bodies->vertex_count()});
  for (const Thread& thread : threads_) {
    result.self_contacts += thread.self_contacts;
    result.counters.pair_tests += thread.pair_tests;
  }
}

}  // namespace collide
