#pragma once
// What every method costs and finds on one frame, over all settings that it has use for: error against run time.

#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/base/timings.h"
#include "app/compare/cost_model.h"
#include "softbody/world.h"

namespace app {

// The axes of a sweep.
inline constexpr std::array<int, 4> sweep_levels{0, 3, 6, 9};
inline constexpr std::array<std::uint32_t, 4> sweep_buckets{101, 1001, 10'007, 1'000'003};
inline constexpr std::array<double, 5> sweep_cells{0.25, 0.5, 1, 2, 4};  // in automatic cell sizes

/// A method with the settings it runs with.
struct Configuration {
  std::size_t method = 0;      // index in collide::method_table()
  collide::Settings settings;  // what the method has no use for is as in the world
  double cell = 1;             // the cell size in units of the automatic one
};

/// The automatic cell size of a level (§2.2): that of the world's bodies at rest, whatever they look like now.
glm::vec3 automatic_cell_size(const softbody::World& world, int levels);

/// Every method with all combinations of those axes that it has use for, in the order of the table; for the rest the
/// world's settings.
std::vector<Configuration> sweep_configurations(const softbody::World& world);

/// What is known of one configuration on the frame.
struct SweepRow {
  Configuration configuration;
  std::string not_run;   // why it was not run, else empty
  bool checked = false;  // the rest but the times is known
  Timings times;         // from scratch each, in the order in which they were taken; empty: not timed yet
  collide::Counters counters;
  collide::Skipped skipped{};
  collide::Coverage coverage = collide::Coverage::exact;
  std::size_t contacts = 0, missed = 0;
  double recall = 1, precision = 1;  // see Score; 1 where there is no reference
  std::size_t memory = 0;            // bytes that a fresh detector and its contacts hold after the frame: see heap.h
};

struct SweepReport {
  std::optional<Configuration> reference;  // whose contacts count as the true ones; nothing: not found yet, or none
  std::string reference_note;              // why that is not brute force, or why there is none; else empty
  std::size_t true_contacts = 0;
  std::vector<SweepRow> rows;  // as the configurations
};

struct SweepLimits {
  std::uint64_t budget =
      1'000'000'000;       // WorkEstimate::cost() that a configuration may be predicted to take: about a second
  int repetitions = 5;     // timed runs of each configuration, at most ...
  double repeat_ms = 500;  // ... and none any more once its runs have taken so long
  std::uint32_t seed = 1;  // of the order
};

/// Runs configurations on one frame: first each with a fresh detector, which checks what it finds and takes; then
/// rounds of timed runs, in a new shuffled order each, so that a drift of the machine's speed favours none. One
/// detector a method takes all of its timed runs. It forgets before each: found from scratch, but after a run that is
/// not timed, which puts scratch memory and caches where they are while frames follow each other.
class Sweep {
 public:
  /// The frame and the workers must outlive the sweep.
  Sweep(const collide::Frame& frame, const std::vector<Configuration>& configurations, const SweepLimits& limits,
        collide::Workers& workers);

  /// One configuration, checked or timed once; the first call finds the true contacts. False once nothing is left to
  /// do.
  bool step();
  /// Of all that is to be done, from 0 to 1.
  double progress() const;
  const SweepReport& report() const { return report_; }

 private:
  void predict();
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
  std::vector<std::size_t> order_;  // rows still to be run in this round, the next one last
  int round_ = -1;                  // -1: the reference is to be found; 0: checks; then timed rounds
};

/// A point of a plot of error against run time.
struct Tradeoff {
  double ms, error;  // error: 1 - recall
};
/// The points than which no other is both at least as fast and at least as good, ascending in time; of equal points
/// the first.
std::vector<std::size_t> pareto_front(const std::vector<Tradeoff>& points);

}  // namespace app
