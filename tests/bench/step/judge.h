#pragma once
// Whether a run stays stable, as numbers that mean the same for every engine: no model's springs or gas are in them.

#include <string>
#include <vector>

#include "app/compare/world_oracle.h"
#include "softbody/world/world.h"

namespace bench {

struct Figures {
  bool finite = true;
  double energy = 0;                      // J above those at the start, kinetic and of gravity, over the sum of m g R
  double volume_min = 1, volume_max = 1;  // of the start's, of any body
  double solid = 0;                       // R, the deepest vertex in a solid
  double inside = 0;                      // R, the deepest vertex in another body
  std::size_t vertices_inside = 0;        // other bodies, the most of all frames looked at
  double speed = 0;                       // m/s, RMS over the bodies' mass, in the last frame
  double lost = 0;                        // s, when the run was given up; 0: it was not
};

struct Bounds {
  double energy = 0.05;  // as in the stability report
  double volume = 2;     // no more than this, nor less than its inverse
  double solid = 0.1;    // R, likewise
  double inside = 0.5;   // R: bodies lie in each other
};
inline constexpr Bounds bounds;

/// What is wrong, in words with the numbers; empty: it is stable.
std::vector<std::string> failures(const Figures& figures);

class Judge {
 public:
  explicit Judge(const softbody::World& start);

  /// After every frame; seconds: since the start.
  void look(const softbody::World& world, double seconds);
  /// Instead of look(): something is not finite.
  void not_finite(double seconds);
  const Figures& figures() const { return figures_; }

 private:
  void look_inside(const softbody::World& world);

  static constexpr int frames_between = 10;  // looks into bodies: exact ones are slow
  double energy_ = 0, scale_ = 0, mass_ = 0, radius_ = 0;
  int frame_ = 0;
  app::compare::WorldOracle oracle_{1};
  Figures figures_;
};

}  // namespace bench
