#pragma once
// Lets the world run, several frames per picture, to a frame that is looked for.

#include <functional>
#include <optional>

#include "app/session/simulation.h"

namespace app::session {

class RunAhead {
 public:
  using Goal = std::function<bool(const softbody::BodiesInMotion&)>;

  /// `simulation` must outlive this.
  explicit RunAhead(Simulation& simulation) : simulation_(simulation) {}

  /// Runs to the first frame from this one on in which `reached` returns true, and pauses there. Gives up after
  /// `max_seconds` of simulated time, or when all bodies are at rest for good. Whatever pauses the world ends the run,
  /// too.
  void start(Goal reached, double max_seconds);
  bool active() const { return run_ && !simulation_.clock.paused; }
  /// Ends the run, if there is one, and pauses.
  void stop();

  // To be called by who advances the simulation, and by its observer.
  void before_advance() {
    if (simulation_.clock.paused) stop();
  }
  /// Ends the run in the frame that it looks for, and where this frame will not come. Returns the time that it took
  /// (ms).
  double stepped();

 private:
  struct Run {
    Goal reached;
    double end;  // s of simulated time
    int frame;   // that was looked at last
  };
  bool goes_on() const;

  Simulation& simulation_;
  std::optional<Run> run_;
};

}  // namespace app::session
