#pragma once
// What `report detection` measures, and its table, page and plots.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/compare/positions.h"
#include "app/compare/run_figures.h"
#include "app/compare/sweep.h"
#include "app/report/page.h"
#include "app/report/sums.h"

namespace app::report {

/// A copy of a frame, and a sweep of it.
struct MeasuredState : compare::FrameCopy {
  int frame = 0;                 // its number
  std::string change{};          // in a study: what was done to the recorded state
  double largest = 1;            // how many times its own size the largest body has
  compare::SweepReport sweep{};  // empty until it is measured
};

/// The same configurations on several states of a scene or of a recorded sequence, or of a study.
struct SceneResult {
  std::string scene, name;    // its key and its name; of a sequence the names of its files
  std::uint32_t buckets = 0;  // the scene's own
  std::vector<compare::Configuration> configurations{};
  std::vector<MeasuredState> states{};  // in the order of their frames
  std::string_view part = "sweep";      // in detection.csv; of a study its key
};

/// Runs the scene and copies states. A scene runs for at most 800 frames, as the paper's do, and is copied after an
/// eighth, half and all of them, and in the frame with the most contacts (the first of them). A large scene runs as far
/// as time allows and is copied twice. `quick` runs less and copies less. Throws UsageError if no body appears, and
/// SceneError.
SceneResult record(const softbody::Scene& scene, bool quick, int threads);

/// Returns the frames of a recorded sequence to measure on: the one with the most contacts (the first of them); unless
/// `quick`, also the last one, and of few vertices those after an eighth and half of all. Throws UsageError or
/// MeshFileError.
SceneResult record_sequence(const ReportOptions& options);

/// What a cost may depend on: one state, changed by several values.
struct CostStudy {
  std::string_view key;  // also of its text on the page
  std::vector<double> values;
  /// Returns the changed state, and says in it what was changed.
  MeasuredState (*changed)(const MeasuredState& state, double value);
};
/// Returns all studies, the growth with the number of bodies first.
std::vector<CostStudy> cost_studies();

/// Returns the `count` bodies nearest to the middle of all: a smaller pile of the same kind.
MeasuredState middle_bodies(const MeasuredState& state, double count);

/// A scene that a method has driven until all bodies slept, or as long as time allows.
struct DrivenRun {
  std::string scene;  // its key
  compare::Configuration configuration;
  Timings detect{};             // of each frame, as the method ran in it
  compare::RunTotals totals{};  // with a look at every tenth frame and at the last one
  collide::Index vertices = 0;  // at the end
};

struct DetectionResults {
  ReportOptions options{};
  compare::SweepLimits limits{};
  TimedParts timed{};                  // all sweeps
  std::vector<SceneResult> scenes{};   // or the one sequence
  std::vector<SceneResult> studies{};  // of the scene with the most bodies, if these are not too few
  std::vector<DrivenRun> runs{};       // scene by scene
};

/// One configuration over all states of a scene.
struct Mean {
  compare::Configuration configuration;
  std::vector<const compare::SweepRow*> rows{};  // of the states
  std::size_t true_contacts = 0;                 // of all states
  bool ran = true;                               // on all states; if not, nothing else has a meaning
  double ms = 0;                                 // mean of the states' medians
  double error = 0;                              // 1 - recall over all states
  double precision = 1;                          // over all states

  template <class Figure>
  double mean(const Figure& figure) const {
    return sum_of(rows, figure) / double(rows.size());
  }
};

/// Returns them in the order of the configurations. They point into the scene.
std::vector<Mean> means(const SceneResult& scene);

/// Returns a method with that level, the automatic cell and those buckets, as far as it uses them; nothing if it was
/// not run. Without buckets, the first number of them that was run.
const Mean* find(const std::vector<Mean>& means, std::string_view method, int level,
                 std::optional<std::uint32_t> buckets = {});

/// Returns the indices of those on the Pareto front of error against run time.
std::vector<std::size_t> pareto_front(const std::vector<Mean>& means);

/// The paper's scenarios and its level of subdivision (Table 1).
inline constexpr std::array<std::string_view, 4> paper_scenes{"A", "B", "C", "D"};
inline constexpr int paper_level = 3;

inline const collide::Method& method_of(const compare::Configuration& c) { return collide::method_table()[c.method]; }
/// True of the automatic cell and that level, as far as the method uses them.
inline bool is_plain(const compare::Configuration& c, int level) {
  return c.cell == 1 && (!method_of(c).uses_levels || c.settings.levels == level);
}

/// Returns detection.csv: every row of every state. What a method does not use, and what was not measured, is empty.
Table detection_table(const DetectionResults& results);

/// Drives a scene by the paper's method at many levels and cell sizes, and by all methods that miss nothing.
void drive(const softbody::Scene& scene, DetectionResults& results);
/// Returns misses.csv: a row for each run.
Table misses_table(const DetectionResults& results);

Page detection_page(const DetectionResults& results);
/// Adds the part on what misses cost, if scenes were driven.
void add_misses(Page& page, const DetectionResults& results);
/// Adds the part on what §3 of the paper claims, the hashes by level, and the studies.
void add_studies(Page& page, const DetectionResults& results);

/// Makes the report: what each detector costs, and what it misses.
void report_detection(const ReportOptions& options);

}  // namespace app::report
