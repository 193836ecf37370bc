#pragma once

#include <stdexcept>

namespace app {

/// Bad input or a run that cannot be done. what() is one line that says what, where and what to do.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
