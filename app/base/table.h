#pragma once
// Tables: rows of named values, written as CSV or as Markdown.

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace app {

/// The text of one cell; empty where a value has no meaning.
class TableCell {
 public:
  TableCell() = default;
  TableCell(std::string t) : text(std::move(t)) {}
  TableCell(std::string_view t) : text(t) {}
  TableCell(const char* t) : text(t) {}
  /// Nine digits.
  TableCell(double number);
  /// 1 or 0 of a bool.
  TableCell(std::integral auto number) : text(std::to_string(number)) {}
  template <class T>
  TableCell(const std::optional<T>& value) : TableCell(value ? TableCell(*value) : TableCell()) {}

  std::string text;
};

/// Returns `value`, or nothing where it has no meaning.
inline TableCell when(bool known, TableCell value) { return known ? std::move(value) : TableCell(); }

struct NamedCell {
  std::string column;
  TableCell cell;
};
using TableRow = std::vector<NamedCell>;

class Table {
 public:
  /// Without columns, the first row names them.
  explicit Table(std::vector<std::string> columns = {}) : rows_{std::move(columns)} {}

  /// Adds a row. Its cells are in the order of the columns; a column that it leaves out is empty.
  void add(const TableRow& row);
  bool empty() const { return rows_.size() == 1; }
  /// Returns the table as CSV (RFC 4180, but lines end with "\n").
  std::string csv() const;
  /// Returns the table as the project's pages keep it. The first `text_columns` hold text, the others numbers.
  std::string markdown(std::size_t text_columns = 1) const;

 private:
  std::vector<std::vector<std::string>> rows_;  // the names of the columns first
};

/// Returns the number in that many significant digits: "0.0123", "12.3", "1,234".
std::string brief(double value, int digits = 3);
/// Returns the nearest whole number: "1,234".
std::string whole(double value);

}  // namespace app
