#pragma once
// Figures of many rows in one.

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

namespace app::report {

/// Returns the sum of a figure of all rows. figure: a member of a row, or a function of it.
template <class Rows, class Figure>
double sum_of(const Rows& rows, const Figure& figure) {
  double sum = 0;
  for (const auto& row : rows) sum += double(std::invoke(figure, row));
  return sum;
}

/// Returns the largest of a figure that is not negative; 0 if there are no rows.
template <class Rows, class Figure>
double max_of(const Rows& rows, const Figure& figure) {
  double max = 0;
  for (const auto& row : rows) max = std::max(max, double(std::invoke(figure, row)));
  return max;
}

/// Returns the groups of rows that follow each other and have the same key.
template <class Rows, class Key>
auto groups_of(const Rows& rows, const Key& key) {
  using Row = typename Rows::value_type;
  std::vector<std::span<const Row>> groups;
  for (auto begin = rows.begin(), end = begin; begin != rows.end(); begin = end) {
    end =
        std::find_if(begin, rows.end(), [&](const Row& r) { return std::invoke(key, r) != std::invoke(key, *begin); });
    groups.emplace_back(begin, end);
  }
  return groups;
}

}  // namespace app::report
