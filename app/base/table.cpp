#include "app/base/table.h"

#include <cassert>
#include <cmath>

#include <fmt/core.h>

#include "app/base/text.h"

namespace app {

TableCell::TableCell(double number) : text(fmt::format("{:.9g}", number)) {}

void Table::add(const TableRow& row) {
  if (rows_[0].empty())
    for (const NamedCell& named : row) rows_[0].push_back(named.column);
  std::vector<std::string> texts;
  auto next = row.begin();
  for (const std::string& column : rows_[0])
    texts.push_back(next != row.end() && next->column == column ? (next++)->cell.text : "");
  assert(next == row.end());
  rows_.push_back(std::move(texts));
}

std::string Table::csv() const {
  std::string text;
  for (const auto& row : rows_) {
    if (row.empty()) continue;  // a table without columns
    for (const std::string& cell : row) {
      const bool plain = cell.find_first_of(",\"\r\n") == std::string::npos;
      if (!plain) text += '"';
      for (const char c : cell) text.append(c == '"' ? 2 : 1, c);
      text += plain ? "," : "\",";
    }
    text.back() = '\n';
  }
  return text;
}

std::string Table::markdown(std::size_t text_columns) const {
  std::string text;
  for (const auto& row : rows_) {
    text += '|';
    for (const std::string& cell : row) text += fmt::format("{}{} |", cell.empty() ? "" : " ", cell);
    text += '\n';
    if (&row != &rows_.front()) continue;
    text += '|';
    for (std::size_t i = 0; i < row.size(); ++i) text += i < text_columns ? "---|" : "--:|";
    text += '\n';
  }
  return text;
}

std::string brief(double value, int digits) {
  assert(digits >= 2);
  if (value >= std::pow(10, digits - 1)) return whole(value);
  return value >= 10 ? fmt::format("{:.{}f}", value, digits - 2) : fmt::format("{:#.{}g}", value, digits);
}

std::string whole(double value) { return grouped(static_cast<std::uint64_t>(std::llround(value))); }

}  // namespace app
