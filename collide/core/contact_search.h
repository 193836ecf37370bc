#pragma once
// Last stage of every method: tests runs of vertices against each other, leaves out what can never be a contact, and
// brings what is left into its one order. Keeps its memory from frame to frame: at most max_contacts contacts and, for
// each thread, 2^20 hits or as many as a run has vertices.

#include <atomic>

#include "collide/core/detector.h"
#include "collide/core/near_pairs.h"

namespace collide {

class ContactSearch {
 public:
  /// All of it must stay alive and unchanged until finish().
  void begin(const Frame& frame, const Settings& settings, const Points& points, int threads);

  /// Finds the contacts of all slots i < j, i from a and j from b. Either b begins with all of a, or a ends where b
  /// begins or before. No pair may come up twice in one frame. Throws std::length_error at more than max_contacts
  /// contacts.
  void test(int thread, Range a, Range b);

  /// The same for each of many short runs that begin where a ends or later: 2^20 pairs at most.
  void test(int thread, Range a, std::span<const Range> runs);

  /// Adds the contacts, the self contacts and the pair tests to a result that BodyBoxes::build() has started.
  void finish(Result& result);

  static constexpr std::size_t max_contacts = std::size_t{1} << 27;  // 1 GiB of them

 private:
  struct alignas(64) Thread {
    std::vector<SlotPair> hits;
    std::vector<Contact> contacts;
    std::uint64_t self_contacts, pair_tests;
  };
  void keep_contacts(Thread& own);

  const Frame* frame_ = nullptr;
  const Points* points_ = nullptr;
  float tolerance2_ = 0;
  bool self_collision_ = true;
  std::vector<Thread> threads_;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace collide
