#pragma once

namespace tests {

/// What hostile.cpp does at a tolerance of so many metres.
enum class Wrong {
  none,
  segfault,
  abort,
  exit,
  endless,
  fork,
  too_many_pairs,
  out_of_range,
  writes_frame,
  much_memory,
  reads_input,
  throws,
  counts
};

}  // namespace tests
