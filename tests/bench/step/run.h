#pragma once
// All entrants on one pile, frame by frame in turn.

#include "tests/bench/step/judge.h"
#include "tests/bench/step/pile.h"
#include "tests/bench/step/stepper.h"

namespace bench {

struct Track {
  const Entrant* entrant;
  std::vector<double> times;  // ms of the processor, one a frame: the least of the repetitions
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
