#include "collide/exact/contact_rows.h"

#include <algorithm>
#include <cassert>

#include "collide/core/workers.h"

namespace collide::exact {

namespace {

/// Sorts the contacts of one first vertex. Long rows pass through a set, which costs less than to sort them. set:
/// empty, and so it is left.
void sort_row(IndexSet& set, std::span<Contact> row) {
  constexpr std::size_t few = 16;
  if (row.size() <= few) {
    for (std::size_t k = 1; k < row.size(); ++k) {
      const Index b = row[k].b;
      std::size_t to = k;
      for (; to > 0 && row[to - 1].b > b; --to) row[to].b = row[to - 1].b;
      row[to].b = b;
    }
    return;
  }
  for (const Contact& contact : row) set.add(contact.b);
  auto at = row.begin();
  set.take_runs(row.front().a, [&](Range run) {
    for (Index b = run.begin; b < run.end; ++b) (at++)->b = b;
  });
}

}  // namespace

void ContactRows::begin(Index vertices, int threads) {
  vertices_ = vertices;
  threads_.resize(static_cast<std::size_t>(threads));
  runs_.clear();
}

void ContactRows::count(int thread, std::span<const Contact> contacts) {
  std::vector<Index>& next = threads_[static_cast<std::size_t>(thread)].next;
  next.assign(vertices_, 0);
  for (const Contact& contact : contacts) ++next[contact.a];
}

std::size_t ContactRows::place(Range vertices, std::size_t place) {
  assert(vertices.end <= vertices_ && (runs_.empty() || runs_.back().vertices.end <= vertices.begin));
  std::size_t end = place;
  for (Index v = vertices.begin; v < vertices.end; ++v) {
    for (Thread& thread : threads_) {
      const Index count = thread.next[v];
      thread.next[v] = static_cast<Index>(end);
      end += count;
    }
  }
  runs_.push_back({vertices, place, end});
  return end;
}

void ContactRows::scatter(int thread, std::span<const Contact> contacts, std::span<Contact> placed) {
  std::vector<Index>& next = threads_[static_cast<std::size_t>(thread)].next;
  for (const Contact& contact : contacts) placed[next[contact.a]++] = contact;
}

/// A share is about as many contacts as those of every other thread. After scatter(), the last thread's next places are
/// the ends of the rows.
void ContactRows::sort(int thread, std::span<Contact> placed) {
  const std::vector<Index>& end = threads_.back().next;
  IndexSet& set = threads_[static_cast<std::size_t>(thread)].row;
  set.reset(vertices_);
  for (const Run& run : runs_) {
    const Part part = part_of(run.end - run.begin, thread, static_cast<int>(threads_.size()));
    const auto first = end.begin() + run.vertices.begin, last = end.begin() + run.vertices.end;
    std::size_t begin = run.begin + part.begin;  // the rows that end behind it, up to the last place of the part
    for (auto row = std::upper_bound(first, last, begin); row != last && *row <= run.begin + part.end; ++row) {
      begin = row == first ? run.begin : *(row - 1);
      sort_row(set, placed.subspan(begin, *row - begin));
    }
  }
}

}  // namespace collide::exact
