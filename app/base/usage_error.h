#pragma once

#include <stdexcept>

namespace app {

/// Bad input, or a run that is not possible. what() is one line: what is wrong, where, and what to do.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace app
