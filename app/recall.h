#pragma once
// Live recall: what methods found on one frozen frame, measured against brute force on the same positions. The work is
// done by a thread of its own on a copy, so the demo never waits for it.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "collide/methods.h"

namespace app {

/// The contacts of one method, ascending, without duplicates.
struct Candidate {
  std::string_view method;  // a key of collide::methods()
  std::vector<collide::Contact> contacts;
};

/// One frame, copied.
struct Snapshot {
  std::uint64_t id = 0;  // the caller's: names the state that was copied
  std::vector<float> x, y, z;
  collide::Bodies bodies;
  collide::Settings settings;
  std::vector<Candidate> found;
};

struct RecallRow {
  std::string_view method;
  double recall = 1;                     // found true contacts / all true contacts; 1 if there are none
  std::vector<collide::Contact> missed;  // false negatives
  std::vector<collide::Contact> extra;   // false positives; none, unless a detector is broken
};

struct RecallReport {
  std::uint64_t id = 0;       // of the snapshot
  std::size_t reference = 0;  // contacts that brute force finds
  double reference_ms = 0;
  std::vector<RecallRow> rows;  // one a candidate, in their order; empty if skipped
  std::string skipped;          // why there is no comparison, else empty
};

/// Distances that brute force evaluates on these bodies.
std::uint64_t predicted_pair_tests(const collide::Bodies& bodies, bool self_collision);

/// Empty, or why bodies as many as these are not compared: brute force would hold a core for more than about a second.
std::string refusal(const collide::Bodies& bodies, bool self_collision);

/// Runs brute force on the snapshot and compares every candidate with it.
RecallReport compare(const Snapshot& snapshot);

class RecallWorker {
 public:
  RecallWorker();

  /// True if an offer would be taken now. After a comparison the worker rests for twice its duration, so that it never
  /// takes more than a third of a core from the simulation and the drawing.
  bool ready() const;
  /// Takes the snapshot, or drops it if not ready(). Never waits for a comparison.
  void offer(Snapshot snapshot);
  /// The latest report that was not yet taken.
  std::optional<RecallReport> take();

 private:
  void work(const std::stop_token& stop);

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable_any wake_;
  std::optional<Snapshot> waiting_;
  std::optional<RecallReport> done_;
  bool busy_ = false;
  double rest_until_ = 0;  // s, steady clock
  std::jthread thread_;    // last: started after, joined before all else
};

}  // namespace app
