#pragma once
// What a restless user does to the demo. One table: each row is as likely as any other.

#include <random>
#include <span>
#include <string_view>

#include "tests/soak/demo_rig.h"

namespace soak {

/// The same numbers for a word with every standard library, others for another word.
class Dice {
 public:
  explicit Dice(std::string_view word) {
    std::seed_seq seed(word.begin(), word.end());
    random_.seed(seed);
  }
  /// 0 .. count - 1.
  std::size_t pick(std::size_t count) { return random_() % count; }
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
