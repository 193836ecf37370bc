#pragma once
// One of those that are timed: a way to move the pile, frame by frame.

#include <memory>
#include <span>
#include <string_view>

#include "softbody/world/world.h"

namespace bench {

inline constexpr int frames_a_second = 60;

class Stepper {
 public:
  Stepper() = default;
  virtual ~Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// The whole step of one frame, in as many steps as were asked for. Only this is timed.
  virtual void step() = 0;
  /// All positions and velocities.
  virtual bool finite() const = 0;
  /// Where everything is after the last step; to be asked for only while all is finite.
  virtual const softbody::World& state() = 0;
};

struct Entrant {
  std::string_view key;
  std::string_view name;
  int steps;  // a frame
  std::unique_ptr<Stepper> (*make)(const softbody::Scene& scene, int steps);
};

/// The first two are the project's own: what the others are divided by.
std::span<const Entrant> entrants();

std::unique_ptr<Stepper> make_vertex_world(const softbody::Scene& scene, int steps);
std::unique_ptr<Stepper> make_surface_world(const softbody::Scene& scene, int steps);
std::unique_ptr<Stepper> make_bullet_vertex_face(const softbody::Scene& scene, int steps);
std::unique_ptr<Stepper> make_bullet_clusters(const softbody::Scene& scene, int steps);

}  // namespace bench
