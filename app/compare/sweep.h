#pragma once
// Measures what each method costs and finds on one frame, over all settings that it uses: error against run time.

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/base/timings.h"
#include "app/compare/cost_model.h"
#include "app/compare/method_style.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::compare {

// The axes of a sweep. Cell sizes are multiples of the automatic one.
inline constexpr std::array<int, 4> sweep_levels{0, 3, 6, 9};
inline constexpr std::array<std::uint32_t, 4> sweep_buckets{101, 1001, 10'007, 1'000'003};
inline constexpr std::array<double, 5> sweep_cells{0.25, 0.5, 1, 2, 4};

/// A method and the settings that it runs with.
struct Configuration {
  std::size_t method = 0;      // index in collide::method_table()
  collide::Settings settings;  // settings that the method does not use are those given
  double cell = 1;             // the cell size in units of the automatic one
};

/// Returns each of the methods with all combinations of the axes that it uses, in the order of the table. The other
/// settings are those given, or the world's. automatic_cell_size: of a level.
std::vector<Configuration> sweep_configurations(const collide::Settings& settings,
                                                const std::function<glm::vec3(int levels)>& automatic_cell_size,
                                                const MethodSet& methods = all_methods());
std::vector<Configuration> sweep_configurations(const softbody::BodiesInMotion& world,
                                                const MethodSet& methods = all_methods());

/// The figures of one configuration on the frame.
struct SweepRow {
  Configuration configuration;
  std::string not_run;   // why it did not run, else empty
  bool checked = false;  // the members below are known, except the times
  Timings times;         // of searches from scratch, in the order of the runs; empty: not timed yet
  collide::Counters counters;
  collide::Skipped skipped{};
  collide::Coverage coverage = collide::Coverage::exact;
  std::size_t contacts = 0, missed = 0;
  double recall = 1, precision = 1;  // see Score; 1 where there is no reference
  std::size_t memory = 0;            // bytes of a new detector and its contacts after the frame, see heap_in_use()
};

struct SweepReport {
  std::optional<Configuration> reference;  // its contacts count as the true ones; nothing: not found yet, or none
  std::string reference_note;              // why the reference is not brute force, or is missing; else empty
  std::size_t true_contacts = 0;
  std::vector<SweepRow> rows;  // by configuration
  TimedParts timed;            // the timed runs, with the processor time of the whole program
};

struct SweepLimits {
  std::uint64_t budget = 1'000'000'000;  // predicted WorkEstimate::cost() of a configuration: about a second
  int repetitions = 5;                   // max timed runs of each configuration
  double repeat_ms = 500;                // no further run once the runs of a configuration have taken so long
};

/// Runs configurations on one frame. First each runs once with a new detector: this checks what it finds and how
/// much memory it takes. Then come rounds of timed runs, each in a new random order, so that a drift of the machine's
/// speed favours none. Timed runs of a method share one detector. It forgets all frames before each run, which is
/// preceded by a run that is not timed: this leaves scratch memory and caches as they are while frames follow each
/// other.
class Sweep {
 public:
  /// The frame must be complete. It and the workers must outlive the sweep.
  Sweep(const collide::Frame& frame, const std::vector<Configuration>& configurations, const SweepLimits& limits,
        collide::Workers& workers);

  /// Checks or times one configuration; the first call finds the true contacts. Returns false if nothing is left to do.
  bool step();
  /// Returns the share of the work that is done, from 0 to 1.
  double progress() const;
  const SweepReport& report() const { return report_; }
  /// Ends the sweep. Returns its report without a copy, for which there may be too little memory.
  SweepReport take_report() { return std::move(report_); }

 private:
  void find_reference();
  std::optional<Configuration> choose_reference();
  void next_round();
  void check(SweepRow& row);
  void time(SweepRow& row);

  collide::Frame frame_;
  SweepLimits limits_;
  collide::Workers& workers_;
  std::mt19937 random_;
  SweepReport report_;
  std::vector<std::uint64_t> predicted_;  // WorkEstimate::cost(), by row
  std::vector<collide::Contact> truth_;
  std::vector<std::unique_ptr<collide::Detector>> detectors_;  // by method, for the timed runs
  collide::Result result_;
  std::vector<std::size_t> order_;  // rows left in this round, the next one last
  int round_ = -1;                  // -1: find the reference; 0: checks; from 1 on: timed rounds
};

/// A point of a plot of error against run time.
struct Tradeoff {
  double ms, error;  // error: 1 - recall
};
/// Returns the Pareto front, ascending in time: the points that no other point equals or beats in both time and error.
/// Of equal points it has the first, and none whose error is infinite.
std::vector<std::size_t> pareto_front(const std::vector<Tradeoff>& points);

}  // namespace app::compare
