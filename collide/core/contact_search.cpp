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
  sort_into(result.contacts);
  for (const Thread& thread : threads_) {
    result.self_contacts += thread.self_contacts;
    result.counters.pair_tests += thread.pair_tests;
  }
}

/// Sorts the contacts of all threads: by counting those of each first vertex, unless they are too few to be worth a
/// pass over all vertices.
void ContactSearch::sort_into(std::vector<Contact>& contacts) {
  const std::size_t vertices = frame_->bodies->vertex_count();
  contacts.clear();
  if (found_ < vertices / 16) {
    for (const Thread& thread : threads_) {
      contacts.insert(contacts.end(), thread.contacts.begin(), thread.contacts.end());
    }
    return std::sort(contacts.begin(), contacts.end());
  }
  end_.assign(vertices + 1, 0);
  for (const Thread& thread : threads_) {
    for (const Contact& contact : thread.contacts) ++end_[contact.a + std::size_t{1}];
  }
  for (std::size_t v = 0; v < vertices; ++v) end_[v + 1] += end_[v];
  contacts.resize(found_);
  for (const Thread& thread : threads_) {
    for (const Contact& contact : thread.contacts) contacts[end_[contact.a]++] = contact;
  }
  auto begin = contacts.begin();  // end_[v] is now where the contacts of v end
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto end = contacts.begin() + end_[v];
    if (end - begin > 1) std::sort(begin, end);
    begin = end;
  }
}

}  // namespace collide
