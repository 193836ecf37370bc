#pragma once

#include <stdexcept>

namespace sbcollide {

/// The one exception that the library throws, besides std::bad_alloc. what() is one line: what is wrong, and what is
/// allowed.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sbcollide
