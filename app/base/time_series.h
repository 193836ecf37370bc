#pragma once
// The last values of a quantity, for plots.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace app {

class TimeSeries {
 public:
  static constexpr std::size_t capacity = 180;  // three seconds of frames

  /// frame: of the world, when it was so.
  void push(int frame, float value) {
    values_[next_] = value;
    frames_[next_] = frame;
    next_ = (next_ + 1) % capacity;
    if (size_ < capacity) ++size_;
  }
  void clear() { next_ = size_ = 0; }
  /// Forgets what was at this frame and after it.
  void forget_from(int frame) {
    for (; size_ > 0 && this->frame(size_ - 1) >= frame; --size_) next_ = (next_ + capacity - 1) % capacity;
  }
  std::size_t size() const { return size_; }
  /// i = 0 is the oldest value kept.
  float operator[](std::size_t i) const { return values_[place(i)]; }
  int frame(std::size_t i) const { return frames_[place(i)]; }
  // 0 if there are no values.
  float max() const {
    return extreme([](float a, float b) { return std::max(a, b); });
  }
  float min() const {
    return extreme([](float a, float b) { return std::min(a, b); });
  }
  float latest() const { return size_ == 0 ? 0 : (*this)[size_ - 1]; }
  /// Of the last values, at most `last` of them; 0 if there are none.
  float median(std::size_t last) const {
    std::vector<float> some;
    for (std::size_t i = size_ - std::min(size_, last); i < size_; ++i) some.push_back((*this)[i]);
    if (some.empty()) return 0;
    const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), middle, some.end());
    return *middle;
  }

 private:
  std::size_t place(std::size_t i) const { return (next_ + capacity - size_ + i) % capacity; }
  float extreme(float (*of)(float, float)) const {
    float found = latest();
    for (std::size_t i = 0; i < size_; ++i) found = of(found, (*this)[i]);
    return found;
  }

  std::array<float, capacity> values_{};
  std::array<int, capacity> frames_{};
  std::size_t next_ = 0, size_ = 0;
};

}  // namespace app
