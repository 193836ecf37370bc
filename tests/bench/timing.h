#pragma once
// All candidates on one state: first the equal sets, then the clock.

#include <stdexcept>
#include <string>

#include "tests/bench/candidate.h"
#include "tests/bench/states.h"

namespace bench {

/// Two candidates disagree. what() is one line that names the candidate, the state and a pair.
struct Difference : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Course {
  const State* state = nullptr;
  float tolerance = 0.25f;  // in the state's unit
  int threads = 1;
  int repeat = 10;  // rounds
};

struct Row {
  const Candidate* candidate;
  double median_ms, min_ms;  // over the rounds: the mean of the frames of one
};

struct Measured {
  Course course;
  std::size_t contacts = 0;  // of the first frame
  std::vector<Row> rows;     // in the order of candidates
};

/// Compares the contacts of every frame with those of a reference (brute force up to 20,000 vertices, else grid hash),
/// and throws Difference before anything is timed. Then every round runs the candidates in shuffled order, each over
/// all frames in a row; the first frame of a round warms up and is not timed, since it follows no frame.
Measured measure(const Course& course, std::span<const Candidate> candidates);

}  // namespace bench
