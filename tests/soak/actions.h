#pragma once
// The actions of a restless user of the demo, in one table. Each row is as likely as any other.

#include <cassert>
#include <random>
#include <span>
#include <string_view>

#include "tests/soak/demo_rig.h"

namespace soak {

/// Random numbers that depend only on the word, not on the standard library.
class Dice {
 public:
  explicit Dice(std::string_view word) {
    std::seed_seq seed(word.begin(), word.end());
    random_.seed(seed);
  }
  /// Returns 0 .. count - 1. count > 0.
  std::size_t pick(std::size_t count) {
    assert(count > 0);
    return random_() % count;
  }
  double between(double lo, double hi) { return lo + (hi - lo) * double(random_()) / 4294967296.0; }
  bool heads() { return random_() % 2 == 0; }

 private:
  std::mt19937 random_;
};

struct Action {
  std::string_view name;
  void (*act)(DemoRig& demo, Dice& dice);
};

std::span<const Action> actions();

}  // namespace soak
