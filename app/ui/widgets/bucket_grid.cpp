#include "app/ui/widgets/bucket_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace app::ui {
namespace {

/// Rounds down to a whole number, at least 1.
std::uint32_t whole(float count) { return static_cast<std::uint32_t>(std::max(1.0f, std::floor(count))); }

}  // namespace

BucketGrid BucketGrid::fit(std::uint32_t buckets, float width, float height, float min_side) {
  assert(buckets > 0 && min_side > 0);
  BucketGrid grid;
  grid.buckets = buckets;
  const std::uint32_t max_squares = whole(width / min_side) * whole(height / min_side);
  grid.per_square = (buckets - 1) / max_squares + 1;
  const std::uint32_t squares = grid.squares();
  // Begins with the side that would fill the area exactly, and shrinks it until whole rows and columns hold all
  // squares.
  grid.side = std::max(min_side, std::floor(std::sqrt(width * height / static_cast<float>(squares))));
  grid.side = std::min({grid.side, width, height});
  while (grid.side > min_side && whole(width / grid.side) * whole(height / grid.side) < squares)
    grid.side = std::max(min_side, grid.side - 1);
  grid.columns = std::min(whole(width / grid.side), squares);
  grid.rows = (squares - 1) / grid.columns + 1;
  return grid;
}

std::optional<std::uint32_t> BucketGrid::square_at(float x, float y) const {
  if (!(x >= 0) || !(y >= 0)) return std::nullopt;
  const auto column = static_cast<std::uint32_t>(x / side), row = static_cast<std::uint32_t>(y / side);
  const std::uint32_t square = row * columns + column;
  if (column >= columns || row >= rows || square >= squares()) return std::nullopt;
  return square;
}

std::uint32_t BucketGrid::last_bucket(std::uint32_t square) const {
  return std::min(buckets - 1, first_bucket(square) + (per_square - 1));
}

}  // namespace app::ui
