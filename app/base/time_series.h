#pragma once
// The last values of a quantity, each with its frame, for plots.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

namespace app {

class TimeSeries {
 public:
  static constexpr std::size_t capacity = 180;  // three seconds of frames

  /// frame: the world's frame in which the value was measured. Values of later frames are forgotten: the world went
  /// back.
  void push(int frame, float value) {
    forget_from(frame + 1);
    values_[next_] = value;
    frames_[next_] = frame;
    next_ = (next_ + 1) % capacity;
    if (size_ < capacity) ++size_;
  }
  void clear() { next_ = size_ = 0; }
  /// Forgets the values of this frame and of all later ones.
  void forget_from(int frame) {
    for (; size_ > 0 && this->frame(size_ - 1) >= frame; --size_) next_ = (next_ + capacity - 1) % capacity;
  }
  std::size_t size() const { return size_; }
  /// Returns value i and its frame. i = 0 is the oldest value kept.
  float operator[](std::size_t i) const { return values_[slot(i)]; }
  int frame(std::size_t i) const { return frames_[slot(i)]; }
  // These three return 0 if there are no values.
  float max() const {
    return extreme([](float a, float b) { return std::max(a, b); });
  }
  float min() const {
    return extreme([](float a, float b) { return std::min(a, b); });
  }
  float latest() const { return size_ == 0 ? 0 : (*this)[size_ - 1]; }
  /// Returns the median of the last values, of at most `last` of them; 0 if there are none.
  float median(std::size_t last) const {
    std::vector<float> values;
    for (std::size_t i = size_ - std::min(size_, last); i < size_; ++i) values.push_back((*this)[i]);
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

 private:
  std::size_t slot(std::size_t i) const {
    assert(i < size_);
    return (next_ + capacity - size_ + i) % capacity;
  }
  float extreme(float (*choose)(float, float)) const {
    float found = latest();
    for (std::size_t i = 0; i < size_; ++i) found = choose(found, (*this)[i]);
    return found;
  }

  std::array<float, capacity> values_{};
  std::array<int, capacity> frames_{};
  std::size_t next_ = 0, size_ = 0;
};

}  // namespace app
