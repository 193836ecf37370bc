#pragma once
// The last stage of every method but the exact one: tests runs of vertices against each other, leaves out pairs that
// can never be contacts, and sorts the contacts. Keeps its memory from frame to frame: at most contact_limit contacts
// and, for each thread, 2^20 hits or as many as a run has vertices.

#include <atomic>

#include "collide/core/contact_sort.h"
#include "collide/core/detector.h"
#include "collide/core/near_pairs.h"

namespace collide {

class ContactSearch {
 public:
  /// Starts a frame whose search is cut into parts, which threads may search at the same time. All arguments must stay
  /// alive and unchanged until finish().
  void begin(const Frame& frame, const Settings& settings, const Points& points, int parts);
  int parts() const { return static_cast<int>(threads_.size()); }

  /// Finds the contacts among all pairs of slots i < j with i in a and j in b. Precondition: b begins with all of a, or
  /// lies behind a. No pair may be tested twice in one frame. Throws std::length_error at more than contact_limit
  /// contacts.
  void test(int thread, Range a, Range b);

  /// Does the same for each of many short runs. None of them overlaps a.
  void test(int thread, Range a, std::span<const Range> runs);

  /// Does the same for a run b that does not overlap a, and that lies in a box: only the slots of a near the box are
  /// tested.
  void test(int thread, Range a, Range b, const Aabb& box_of_b);

  /// Adds the sorted contacts, the number of self contacts and the pair tests to a result that BodyBoxes::build()
  /// cleared.
  void finish(Result& result);

 private:
  struct alignas(64) Thread {
    std::vector<SlotPair> hits;
    std::vector<Contact> contacts;
    std::uint64_t self_contacts, pair_tests;
  };
  void keep_contacts(Thread& own);

  const Frame* frame_ = nullptr;
  const Points* points_ = nullptr;
  float tolerance2_ = 0, cutoff_ = 0;
  bool self_collision_ = true;
  std::vector<Thread> threads_;
  std::atomic<std::size_t> found_ = 0;
  ContactSort sort_;
};

}  // namespace collide
