#pragma once
// How the buckets of a hash table are laid out as squares in a rectangle.

#include <cstdint>
#include <optional>

namespace app {

struct HashGrid {
  std::uint32_t buckets = 1;
  std::uint32_t per_square = 1;  // consecutive buckets that share a square, 1 unless they are too many
  std::uint32_t columns = 1, rows = 1;
  float side = 1;  // of a square, the gap included

  /// The largest squares that fit, but none smaller than `least_side`: then neighbours share squares.
  static HashGrid fit(std::uint32_t buckets, float width, float height, float least_side);

  std::uint32_t squares() const { return (buckets - 1) / per_square + 1; }
  /// The square at a point from the grid's top left corner.
  std::optional<std::uint32_t> square_at(float x, float y) const;
  std::uint32_t first_bucket(std::uint32_t square) const { return square * per_square; }
  std::uint32_t last_bucket(std::uint32_t square) const;
};

}  // namespace app
