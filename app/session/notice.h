#pragma once
// Short texts for the user.

#include <algorithm>
#include <string>
#include <utility>

namespace app::session {

/// What went wrong last, or what was done last, in words for the user. It goes with the next action, or after a while.
class Notice {
 public:
  const std::string& text() const { return text_; }
  bool is_error() const { return is_error_ && !text_.empty(); }
  /// Shows an error. The same error again does not stay longer.
  void set(std::string text) {
    if (text != text_) age_ = 0;
    text_ = std::move(text);
    is_error_ = true;
  }
  /// Shows for a short while what was done.
  void tell(std::string text) {
    age_ = 0;
    text_ = std::move(text);
    is_error_ = false;
  }
  void clear() { text_.clear(); }
  /// Lets `elapsed` seconds of real time pass. Clears a text that has stood long enough.
  void age(double elapsed) {
    age_ += std::min(elapsed, max_elapsed);
    if (age_ > (is_error_ ? max_error_age : max_message_age)) clear();
  }

 private:
  static constexpr double max_error_age = 20, max_message_age = 4, max_elapsed = 0.5;  // s

  std::string text_;
  bool is_error_ = false;
  double age_ = 0;  // s
};

/// A problem with what was typed into a field, or a question about it. It goes when the field is changed.
class FieldNotice {
 public:
  void set(std::string field, std::string text) {
    field_ = std::move(field);
    text_ = std::move(text);
  }
  void clear() { text_.clear(); }
  /// Returns the text, if it is about this content of the field; else an empty one.
  std::string about(const std::string& field) const { return field == field_ ? text_ : std::string(); }

 private:
  std::string field_, text_;
};

}  // namespace app::session
