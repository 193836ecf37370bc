#pragma once
// A contact, as the library and its users have it.

#include <compare>
#include <cstdint>

namespace sbcollide {

/// A vertex, a body or a triangle, counted from 0.
using Index = std::uint32_t;

/// A pair of vertices a < b, numbered over all bodies.
struct Contact {
  Index a, b;
  auto operator<=>(const Contact&) const = default;
};

}  // namespace sbcollide
