#pragma once
// All entrants on one pile, frame by frame in turn.

#include "tests/bench/step/judge.h"
#include "tests/bench/step/pile.h"
#include "tests/bench/step/stepper.h"

namespace bench {

struct Times {
  std::vector<double> cpu, wall;  // ms, one a frame: the least of the repetitions
};

struct Track {
  const Entrant* entrant;
  Times times;
  Figures figures;
};

struct Course {
  const Gas* gas;
  int frames;
  int repeat;
};

/// Every repetition starts anew and goes the same way.
std::vector<Track> run(const Course& course, std::span<const Entrant* const> entrants);

}  // namespace bench
