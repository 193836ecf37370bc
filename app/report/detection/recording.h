#pragma once
// States of a scene that a report measures on.

#include "app/compare/positions.h"
#include "app/compare/sweep.h"

namespace app {

/// One frame, copied.
struct RecordedState {
  int frame = 0;
  Positions at;
  collide::Bodies bodies;

  collide::Frame view() const { return {at.x, at.y, at.z, &bodies}; }
};

struct Recording {
  std::string scene, name;  // its key, and what it calls itself
  std::uint32_t buckets;    // the scene's own
  std::vector<Configuration> configurations;
  std::vector<RecordedState> states;  // in the order of their frames
};

/// How long to run a scene, and when to copy it.
struct RecordingPlan {
  std::vector<int> frames;  // ascending, the last one ends the run
  bool busiest = false;     // also the frame with the most contacts (the first of them)
};

/// The plan for a scene of so many vertices. Up to 800 frames, the paper's: after an eighth, half and all of them, and
/// the busiest. Large scenes run as far as time allows and are copied twice; `quick` runs less and copies less.
RecordingPlan plan_recording(std::uint64_t vertices, bool quick);

/// Vertices of all bodies that will have arrived at the end.
std::uint64_t vertex_count(const softbody::Scene& scene);

/// Throws UsageError if no body arrives, and SceneError.
Recording record(const softbody::Scene& scene, const RecordingPlan& plan, int threads);

/// The `count` bodies nearest to the middle of all: a smaller pile of the same kind.
RecordedState middle_bodies(const RecordedState& state, collide::Index count);

}  // namespace app
