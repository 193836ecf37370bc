#pragma once
// Arbitrary bytes read as numbers. Where they end, all further ones are 0.

#include <cstdint>
#include <random>
#include <span>

#include "tests/collide/states.h"

namespace fuzz {

class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  bool empty() const { return left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  /// 0 .. count - 1, count <= 256.
  int below(int count) { return byte() % count; }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (int k = 0; k < 4; ++k) value = value << 8 | byte();
    return value;
  }
  /// -1 .. 1 in steps of 1/128.
  float fraction() { return static_cast<float>(static_cast<std::int8_t>(byte())) / 128.0f; }
  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }
  /// Digits that no mutation has to find one by one: drawn by a generator that the bytes seed.
  std::mt19937 random() { return std::mt19937(word()); }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace fuzz
