#pragma once
// The last values of a quantity, each with its frame, for plots.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <deque>
#include <vector>

namespace app {

class TimeSeries {
 public:
  static constexpr std::size_t capacity = 180;  // three seconds of frames

  /// frame: the world's frame in which the value was measured. Values of later frames are forgotten: the world went
  /// back.
  void push(int frame, float value) {
    forget_from(frame + 1);
    values_.push_back({frame, value});
    if (values_.size() > capacity) values_.pop_front();
  }
  void clear() { values_.clear(); }
  /// Forgets the values of this frame and of all later ones.
  void forget_from(int frame) {
    while (!values_.empty() && values_.back().frame >= frame) values_.pop_back();
  }
  std::size_t size() const { return values_.size(); }
  /// Returns value i and its frame. i = 0 is the oldest value kept.
  float operator[](std::size_t i) const { return entry(i).value; }
  int frame(std::size_t i) const { return entry(i).frame; }
  // These return 0 if there are no values.
  float max() const { return values_.empty() ? 0 : std::ranges::max(values_, {}, &Entry::value).value; }
  float min() const { return values_.empty() ? 0 : std::ranges::min(values_, {}, &Entry::value).value; }
  float latest() const { return values_.empty() ? 0 : values_.back().value; }
  /// Returns the median of the last values, of at most `last` of them.
  float median(std::size_t last) const {
    std::vector<float> values;
    for (std::size_t i = size() - std::min(size(), last); i < size(); ++i) values.push_back((*this)[i]);
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

 private:
  struct Entry {
    int frame;
    float value;
  };
  const Entry& entry(std::size_t i) const {
    assert(i < size());
    return values_[i];
  }

  std::deque<Entry> values_;
};

}  // namespace app
