#pragma once
// Compares methods on a copy of one frame: the cost of each, and how many of the true contacts it finds.

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/base/background.h"
#include "app/compare/cost_model.h"
#include "app/compare/method_style.h"
#include "app/compare/positions.h"
#include "app/compare/score.h"

namespace app::compare {

/// Returns the index of a key in collide::method_table(), which must have it.
std::size_t method_index(std::string_view key);

/// Returns the method whose contacts count as the true ones: brute force if can_run(its index), else the first exact
/// method that can run and shares little code with `beside`: one of the two has levels, at most one has a hash, and the
/// reference has not both, since the exact method shares its levels and the grids share its hash. Returns nothing if
/// there is none.
std::optional<std::size_t> choose_reference(const collide::Method& beside,
                                            const std::function<bool(std::size_t)>& can_run);

/// A copy of one frame, and the methods to run on it.
struct FrameSnapshot : FrameCopy {
  std::uint64_t id = 0;     // the caller's number of the copied state
  std::uint64_t world = 0;  // differs from world to world
  int frame_number = 0;     // of the world
  collide::Settings settings;
  std::size_t driver = 0;  // index of the method that drives the bodies
  collide::Result found;   // the result of that method
  MethodSet chosen;        // to be run, too; empty: none
};

/// The figures of one method on the frame.
struct CompareRow : Score {
  std::optional<double> ms;  // on one core; only of chosen methods
  std::string not_run;       // why a chosen method did not run, else empty

  bool scored = false;  // the score and the members below are known: there is a reference, and the method ran or drives
  collide::Counters counters;
  collide::Coverage coverage = collide::Coverage::exact;
  std::size_t contacts = 0;
  float missed_distance = 0, false_distance = 0;  // m, between the vertices of the first missed and the first false one
};

struct CompareReport {
  std::uint64_t id = 0;                  // of the snapshot; 0: nothing was compared yet
  int frame = 0;                         // the snapshot's frame_number
  std::optional<std::size_t> reference;  // the method whose contacts count as the true ones
  std::size_t true_contacts = 0;
  double reference_ms = 0;
  std::string reference_note;      // why the reference is not brute force, or is missing; else empty
  std::vector<std::size_t> order;  // in which the methods were timed
  std::vector<CompareRow> rows;    // by method
};

/// Runs the methods one after another, as a task for Background. Each has a detector of its own, which is kept from
/// frame to frame of a world.
class Comparison {
 public:
  using Question = FrameSnapshot;
  using Answer = CompareReport;
  /// The pair tests that one method may take on one frame: about a second on one core.
  static constexpr std::uint64_t default_budget = work_of_part(1'000'000'000);

  explicit Comparison(std::uint32_t seed, std::uint64_t budget = default_budget) : budget_(budget), random_(seed) {}

  /// Times the chosen methods within the budget, one a part, in a new random order for each snapshot. The reference is
  /// brute force; where this exceeds the budget, an exact method of another kind than the driver. A comparison that
  /// fails, as with too little memory, says so in its report. The report of a cancelled comparison is worthless.
  std::optional<CompareReport> advance(const FrameSnapshot& snapshot, const Background<Comparison>& background);

 private:
  struct Entry {
    std::unique_ptr<collide::Detector> detector;
    collide::Result result{};
    std::optional<double> ms{};  // nothing: has not run on this frame
    std::string error{};
  };

  void begin(const FrameSnapshot& snapshot);
  void detect(std::size_t method, const FrameSnapshot& snapshot);
  std::optional<std::size_t> find_reference(const FrameSnapshot& snapshot);
  void score(const FrameSnapshot& snapshot);

  std::uint64_t budget_;
  std::mt19937 random_;
  std::vector<Entry> entries_;  // by method; those that have joined the table since the last begin() are missing
  std::uint64_t world_ = 0;     // of the last frame
  CostModel cost_model_;
  std::optional<CompareReport> report_;  // of the snapshot at hand
  std::size_t timed_ = 0;                // of its order
  collide::Workers alone_{1};
};

}  // namespace app::compare
