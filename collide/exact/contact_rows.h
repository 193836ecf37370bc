#pragma once
// Sorts contacts that threads have found in no order: by counting those of each first vertex, on all threads. Memory,
// beside the contacts: 4 bytes a vertex and thread.

#include <span>

#include "collide/core/index_set.h"
#include "collide/core/result.h"

namespace collide::exact {

/// A row holds the contacts of one first vertex.
class ContactRows {
 public:
  /// Starts a frame of so many vertices.
  void begin(Index vertices, int threads);
  /// Counts the contacts of a thread. To be called by all threads before place().
  void count(int thread, std::span<const Contact> contacts);
  /// Places the rows of some vertices one after another, beginning at `place`. Returns the place behind them. To be
  /// called with ascending vertices.
  std::size_t place(Range vertices, std::size_t place);
  /// Moves the contacts of a thread to their rows. To be called by all threads before sort().
  void scatter(int thread, std::span<const Contact> contacts, std::span<Contact> placed);
  /// Sorts a thread's share of the rows.
  void sort(int thread, std::span<Contact> placed);

 private:
  struct alignas(64) Thread {
    std::vector<Index> next;  // by vertex: how many contacts, then the place of the next one
    IndexSet row;
  };
  struct Run {
    Range vertices;
    std::size_t begin, end;  // of their contacts
  };

  Index vertices_ = 0;
  std::vector<Thread> threads_;
  std::vector<Run> runs_;
};

}  // namespace collide::exact
