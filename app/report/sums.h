#pragma once
// Figures of many rows in one.

#include <algorithm>
#include <functional>

namespace app::report {

/// Returns the sum of a figure of all rows. figure: a member of a row, or a function of it.
template <class Rows, class Figure>
double sum_of(const Rows& rows, const Figure& figure) {
  double sum = 0;
  for (const auto& row : rows) sum += static_cast<double>(std::invoke(figure, row));
  return sum;
}

/// Returns the largest of a figure that is not negative; 0 if there are no rows.
template <class Rows, class Figure>
double max_of(const Rows& rows, const Figure& figure) {
  double max = 0;
  for (const auto& row : rows) max = std::max(max, static_cast<double>(std::invoke(figure, row)));
  return max;
}

}  // namespace app::report
