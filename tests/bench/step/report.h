#pragma once

#include "tests/bench/step/run.h"

namespace bench {

struct Result {
  Course course;
  std::vector<Track> tracks;
};

void print_table(const Result& result);
/// Prints the processor times and the verdicts of all as one table.
void print_csv(const std::vector<Result>& all);
void print_json(const std::vector<Result>& all);

}  // namespace bench
