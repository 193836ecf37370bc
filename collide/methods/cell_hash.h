#pragma once
// The grid and the hash function of §2.2:
//   index = (floor(x/length)*xprime + floor(y/height)*yprime + floor(z/width)*zprime) % bucketsize

#include <algorithm>
#include <cassert>
#include <utility>

#include "collide/core/detector.h"

namespace collide::methods {

class CellHash {
 public:
  using Cell = std::array<std::int64_t, 3>;

  explicit CellHash(const Settings& settings) : prime_(settings.primes), buckets_(settings.buckets) {
    assert(settings.cell_size);
    for (int axis = 0; axis < 3; ++axis) size_[static_cast<std::size_t>(axis)] = (*settings.cell_size)[axis];
  }

  /// Returns floor(value / cell size), clamped so that every coordinate has an index. Monotonic in value.
  std::int64_t index(int axis, double value) const {
    constexpr double limit = 0x1p60;
    const double quotient = value / size_[static_cast<std::size_t>(axis)];
    const double clamped = quotient < -limit ? -limit : quotient > limit ? limit : quotient;
    const auto truncated = static_cast<std::int64_t>(clamped);
    return truncated - (static_cast<double>(truncated) > clamped ? 1 : 0);
  }

  Cell cell(double x, double y, double z) const { return {index(0, x), index(1, y), index(2, z)}; }

  /// Returns one summand of the hash: the index, reduced modulo the bucket count so that nothing overflows, times the
  /// prime.
  std::uint64_t term(int axis, std::int64_t index) const {
    const auto count = static_cast<std::int64_t>(buckets_);
    const std::int64_t rest = index % count;
    return static_cast<std::uint64_t>(rest < 0 ? rest + count : rest) * prime_[static_cast<std::size_t>(axis)];
  }

  std::uint32_t bucket(const Cell& cell) const {
    return static_cast<std::uint32_t>((term(0, cell[0]) + term(1, cell[1]) + term(2, cell[2])) % buckets_);
  }

  /// The same modulo the bucket count, for summands that many corners share, and the bucket of three such residues.
  std::uint32_t residue(int axis, std::int64_t index) const {
    return static_cast<std::uint32_t>(term(axis, index) % buckets_);
  }
  std::uint32_t bucket_of_residues(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const auto count = static_cast<std::uint32_t>(buckets_);
    const auto once = [count](std::uint32_t sum) { return sum >= count ? sum - count : sum; };
    return once(once(x + y) + z);
  }

 private:
  std::array<double, 3> size_;
  std::array<std::uint32_t, 3> prime_;
  std::uint64_t buckets_;
};

/// The cells lo .. hi along each axis, both included.
struct CellRange {
  CellHash::Cell lo, hi;

  /// Returns the number of cells, as a double: there may be 2^183.
  double count() const {
    double product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) product *= static_cast<double>(hi[axis] - lo[axis] + 1);
    return product;
  }

  /// Calls visit(cell) for each cell; x changes slowest, and the cell of the minimum corner comes first.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::int64_t x = lo[0]; x <= hi[0]; ++x) {
      for (std::int64_t y = lo[1]; y <= hi[1]; ++y) {
        for (std::int64_t z = lo[2]; z <= hi[2]; ++z) visit(CellHash::Cell{x, y, z});
      }
    }
  }
};

/// How many cells all boxes of a frame may fill lists with before only boxes in few cells are listed.
inline constexpr double room_for_cells = 0x1p24;

/// Returns the number of cells that are looked into, or listed, one by one for a vertex or a box. Where there are more,
/// the test of all vertices takes less time: a cell takes as long as 32 tests. room: how many cells may be listed, for
/// the sake of memory; a box up to two cells wide, in 27 cells at most, is always listed, so that the work of very many
/// such boxes does not grow with their square.
inline double max_listed_cells(double vertices, double room = room_for_cells) {
  return std::min(std::max(64.0, vertices / 32), std::max(27.0, room));
}

/// Collects cells for drawing: the first DebugGeometry::debug_cell_limit of those added; ascending, without duplicates.
class CellList {
 public:
  void add(const CellHash::Cell& cell, const CellHash& hash) {
    cells_.push_back({cell, hash.bucket(cell)});
    if (cells_.size() >= 4 * DebugGeometry::debug_cell_limit) tidy();
  }
  std::vector<DebugGeometry::Cell> take() {
    tidy();
    return std::move(cells_);
  }

 private:
  void tidy() {
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    if (cells_.size() > DebugGeometry::debug_cell_limit) cells_.resize(DebugGeometry::debug_cell_limit);
  }

  std::vector<DebugGeometry::Cell> cells_;
};

}  // namespace collide::methods
