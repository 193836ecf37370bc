#include "app/ui/widgets/hash_grid.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

std::uint32_t whole(float lengths) { return static_cast<std::uint32_t>(std::max(1.0f, std::floor(lengths))); }

}  // namespace

HashGrid HashGrid::fit(std::uint32_t buckets, float width, float height, float least_side) {
  HashGrid grid;
  grid.buckets = buckets;
  const std::uint32_t most = whole(width / least_side) * whole(height / least_side);
  grid.per_square = (buckets - 1) / most + 1;
  const std::uint32_t squares = grid.squares();
  // The side that would fill the area exactly, then less until whole rows and columns hold all squares.
  grid.side = std::max(least_side, std::floor(std::sqrt(width * height / static_cast<float>(squares))));
  grid.side = std::min({grid.side, width, height});
  while (grid.side > least_side && whole(width / grid.side) * whole(height / grid.side) < squares) {
    grid.side = std::max(least_side, grid.side - 1);
  }
  grid.columns = std::min(whole(width / grid.side), squares);
  grid.rows = (squares - 1) / grid.columns + 1;
  return grid;
}

std::optional<std::uint32_t> HashGrid::square_at(float x, float y) const {
  if (!(x >= 0) || !(y >= 0)) return std::nullopt;
  const auto column = static_cast<std::uint32_t>(x / side), row = static_cast<std::uint32_t>(y / side);
  const std::uint32_t square = row * columns + column;
  if (column >= columns || row >= rows || square >= squares()) return std::nullopt;
  return square;
}

std::uint32_t HashGrid::last_bucket(std::uint32_t square) const {
  return std::min(buckets - 1, first_bucket(square) + (per_square - 1));
}

}  // namespace app
