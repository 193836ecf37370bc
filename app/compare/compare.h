#pragma once
// Methods side by side on one frozen frame: what each costs, and what it finds of the true contacts.

#include <memory>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "app/compare/cost_model.h"
#include "app/compare/positions.h"

namespace app {

/// The index of a key in collide::method_table(), which must have it.
std::size_t method_index(std::string_view key);

/// One frame, copied, and what to run on it.
struct FrameSnapshot {
  std::uint64_t id = 0;     // the caller's: names the state that was copied
  std::uint64_t world = 0;  // another number, another world
  int frame_number = 0;     // of the world
  Positions at;
  collide::Bodies bodies;
  collide::Settings settings;
  std::size_t driver = 0;    // index of the method that drives the bodies
  collide::Result found;     // what it found
  std::vector<bool> chosen;  // by method: to be run beside it; empty: none

  collide::Frame frame() const { return {at.x, at.y, at.z, &bodies}; }
};

/// What is known of one method on the frame.
struct CompareRow {
  std::optional<double> ms;  // of its detector, alone on one core; only of those chosen
  std::string not_run;       // why a chosen method was not run, else empty

  bool scored = false;  // the rest is of this frame: the method ran, or drives, and there is a reference
  collide::Counters counters;
  collide::Coverage coverage = collide::Coverage::exact;
  std::size_t contacts = 0;
  double recall = 1;                     // found true contacts / all true contacts; 1 if there are none
  double precision = 1;                  // found true contacts / all found; 1 if none is found
  std::vector<collide::Contact> missed;  // false negatives
};

struct CompareReport {
  std::uint64_t id = 0;                  // of the snapshot; 0: nothing compared yet
  int frame = 0;                         // the snapshot's frame_number
  std::optional<std::size_t> reference;  // the method whose contacts count as the true ones
  std::size_t true_contacts = 0;
  double reference_ms = 0;
  std::string reference_note;      // why the reference is not brute force, or why there is none; else empty
  std::vector<std::size_t> order;  // in which methods were timed
  std::vector<CompareRow> rows;    // by method
};

/// Runs the methods one after another, each with a detector of its own that it keeps from frame to frame.
class Comparison {
 public:
  /// Pair tests that one method may take on one frame: about a second of one core.
  static constexpr std::uint64_t default_budget = 1'000'000'000;

  explicit Comparison(std::uint32_t seed, std::uint64_t budget = default_budget);

  /// Times the chosen methods within the budget, in a new shuffled order with every call; brute force, or an exact
  /// method of another kind than the driver where brute force exceeds the budget, is the reference, outside of the
  /// timed part. A stop asked for is heeded between two methods; the report is worthless then.
  CompareReport run(const FrameSnapshot& snapshot, const std::stop_token& stop = {});

 private:
  struct Entry {
    std::unique_ptr<collide::Detector> detector;
    collide::Result result;
    double ms = 0;
    bool done = false;  // on this frame
    std::string error;
  };

  std::vector<std::size_t> choose(const FrameSnapshot& snapshot, CompareReport& report);
  void detect(std::size_t method, const FrameSnapshot& snapshot);
  std::optional<std::size_t> find_reference(const FrameSnapshot& snapshot, std::string& reference_note) const;
  void score(const FrameSnapshot& snapshot, CompareReport& report) const;

  std::uint64_t budget_;
  std::mt19937 random_;
  std::vector<Entry> entries_;  // by method
  CostModel cost_model_;
  collide::Workers alone_{1};
};

}  // namespace app
