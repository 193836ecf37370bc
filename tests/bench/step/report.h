#pragma once

#include "tests/bench/step/run.h"

namespace bench {

struct Result {
  Course course;
  std::vector<Track> tracks;
};

void print_table(const Result& result);
void print_json(const std::vector<Result>& all);

}  // namespace bench
