#pragma once
// States of a scene or of a recorded sequence that a report measures on.

#include "app/compare/positions.h"
#include "app/compare/sweep.h"
#include "app/report/report.h"

namespace app::report {

/// A copy of a frame, and its number.
struct RecordedState : compare::FrameCopy {
  int frame = 0;
};

struct Recording {
  std::string scene, name;  // its key and its name
  std::uint32_t buckets;    // the scene's own
  std::vector<compare::Configuration> configurations;
  std::vector<RecordedState> states;  // in the order of their frames
};

/// Runs the scene and copies states. A scene runs for at most 800 frames, as the paper's do, and is copied after an
/// eighth, half and all of them, and in the frame with the most contacts (the first of them). A large scene runs as far
/// as time allows and is copied twice. `quick` runs less and copies less. Throws UsageError if no body appears, and
/// SceneError.
Recording record(const softbody::Scene& scene, bool quick, int threads);

/// Returns the frames of a recorded sequence to measure on: the one with the most contacts (the first of them); unless
/// `quick`, also the last one, and of few vertices those after an eighth and half of all. Throws UsageError or
/// MeshFileError.
Recording record_sequence(const ReportOptions& options);

/// Returns the `count` bodies nearest to the middle of all: a smaller pile of the same kind.
RecordedState middle_bodies(const RecordedState& state, collide::Index count);

}  // namespace app::report
