#pragma once
// Runs detectors over a recorded sequence: one of them, or all side by side.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/base/timings.h"
#include "app/files/frame_sequence.h"
#include "collide/methods.h"

namespace app::cli {

/// A recorded sequence and how to run over it.
struct SequenceTask {
  std::vector<std::string> files;              // by frame
  std::vector<files::SequenceFrame> frames{};  // all with the same bodies
  collide::Settings settings{};
  double tolerance = 0;  // m, as typed: texts show it, since the float of the settings has other digits
  int threads = 1;
  int repeat = 1;                    // runs over the whole sequence, each with a new detector
  bool reuse = true;                 // a detector may use data of earlier frames
  std::vector<std::string> notes{};  // what the authors of the files may have meant differently

  const files::SequenceBodies& of() const { return *frames.front().of; }
};

/// What a method found of the true contacts of a frame.
struct Found {
  std::size_t true_contacts = 0, of_them = 0;
  std::optional<collide::Contact> first_missed{}, first_false{};
};

/// The figures of a method in one frame.
struct DetectRow {
  std::size_t contacts = 0;
  std::uint64_t self_contacts = 0;
  collide::Counters counters;
  collide::Skipped skipped{};
  Timings times;               // by repetition
  std::optional<Found> found;  // nothing where the true contacts are not known
};

struct MethodRun {
  const collide::Method* method;
  std::vector<DetectRow> rows;  // by frame; those that it did not reach are missing
  std::string not_run;          // why it did not run to the end, else empty
};

/// Is called with the number of a frame and its contacts in the first run over the sequence. It may sort them.
using ContactsSink = std::function<void(std::size_t frame, std::vector<collide::Contact>& contacts)>;

/// Runs one method. Throws UsageError if a frame has more contacts than a method may report.
MethodRun run_method(const collide::Method& method, const SequenceTask& task, const ContactsSink& sink);

/// The most work of one method on all frames, if all methods run: compare::WorkEstimate::cost(). It takes about half a
/// minute on one core.
inline constexpr std::uint64_t max_work = 60'000'000'000;

/// All methods side by side.
struct MethodRuns {
  const collide::Method* reference = nullptr;  // its contacts count as the true ones; nullptr: none could be found
  std::vector<MethodRun> runs;                 // in the order of the table
};

/// Runs all methods, each as run_method() does, frame after frame. A method that would take more than max_work does not
/// run, or not to the end. The reference is brute force; where this would take too much work, the exact method of
/// another kind than the default one, or the default one itself.
MethodRuns run_all_methods(const SequenceTask& task);

}  // namespace app::cli
