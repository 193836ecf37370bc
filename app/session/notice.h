#pragma once

#include <algorithm>
#include <string>

namespace app::session {

/// What went wrong last, in words for the user. It goes with the next successful action, or after a while.
class Notice {
 public:
  const std::string& text() const { return text_; }
  void set(std::string text) { text_ = std::move(text); }
  void clear() { text_.clear(); }
  /// Lets `elapsed` seconds of real time pass. Clears a text that has stood for max_age.
  void age(double elapsed) {
    age_ = text_ == aged_text_ ? age_ + std::min(elapsed, max_elapsed) : 0;
    if (age_ > max_age) clear();
    aged_text_ = text_;
  }

 private:
  static constexpr double max_age = 20, max_elapsed = 0.5;  // s

  std::string text_, aged_text_;
  double age_ = 0;  // s, of aged_text_
};

}  // namespace app::session
