#pragma once
// The figures as a table for people and as one JSON document for programs.

#include "tests/bench/timing.h"

namespace bench {

/// To standard output: ms a frame, ns a vertex, and how many times the first candidate's time.
void print_table(const Measured& measured);

/// Prints a row for each state and tolerance: the time of the first candidate, and those of the others as multiples.
void print_csv(const std::vector<Measured>& all);
void print_json(const std::vector<Measured>& all);

}  // namespace bench
