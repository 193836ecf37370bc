#pragma once
// The last values of a quantity, for plots.

#include <array>
#include <cstddef>

namespace app {

class Ring {
 public:
  static constexpr std::size_t capacity = 180;  // three seconds of frames

  void push(float value) {
    values_[next_] = value;
    next_ = (next_ + 1) % capacity;
    if (size_ < capacity) ++size_;
  }
  void clear() { next_ = size_ = 0; }
  std::size_t size() const { return size_; }
  /// i = 0 is the oldest value kept.
  float operator[](std::size_t i) const { return values_[(next_ + capacity - size_ + i) % capacity]; }
  float largest() const {
    float most = 0;
    for (std::size_t i = 0; i < size_; ++i) most = values_[i] > most ? values_[i] : most;
    return most;
  }

 private:
  std::array<float, capacity> values_{};
  std::size_t next_ = 0, size_ = 0;
};

}  // namespace app
