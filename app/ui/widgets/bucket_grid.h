#pragma once
// The layout of a hash table's buckets as squares in a rectangle.

#include <cstdint>
#include <optional>

namespace app::ui {

inline constexpr float min_square = 4;  // design pixels: smaller ones are hard to hit with the mouse

struct BucketGrid {
  std::uint32_t buckets = 1;
  std::uint32_t per_square = 1;  // consecutive buckets that share a square; 1 unless there are too many
  std::uint32_t columns = 1, rows = 1;
  float side = 1;  // of a square, with the gap

  /// Finds the largest squares that fit. If they would be smaller than `min_side`, neighbours share squares. There must
  /// be at least one bucket.
  static BucketGrid fit(std::uint32_t buckets, float width, float height, float min_side);

  std::uint32_t squares() const { return (buckets - 1) / per_square + 1; }
  /// Returns the square at a point, measured from the grid's top left corner.
  std::optional<std::uint32_t> square_at(float x, float y) const;
  std::uint32_t first_bucket(std::uint32_t square) const { return square * per_square; }
  std::uint32_t last_bucket(std::uint32_t square) const;
};

}  // namespace app::ui
