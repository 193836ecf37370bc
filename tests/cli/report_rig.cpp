#include "tests/cli/report_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/csv_fields.h"

namespace cli::test {
std::vector<Row> read_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const auto names = csv_fields(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const auto values = csv_fields(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    for (std::size_t i = 0; i < std::min(values.size(), names.size()); ++i) {
      if (i == 0) rows.emplace_back();
      rows.back()[names[i]] = values[i];
    }
  }
  return rows;
}

double number(const std::string& text) {
  std::size_t end = 0;
  const double value = text.empty() ? -1 : std::stod(text, &end);
  EXPECT_TRUE(!text.empty() && end == text.size()) << "'" << text << "' is no number";
  return value;
}

std::set<std::string> printed_files(const Outcome& report, const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::istringstream lines(report.out);
  for (std::string line; std::getline(lines, line);) {
    const std::filesystem::path file = line;
    EXPECT_EQ(file.parent_path(), folder);
    EXPECT_TRUE(names.insert(file.filename()).second) << line << " is there twice";
  }
  return names;
}

std::string errors_of(const Outcome& report) {
  std::string rest;
  std::istringstream lines(report.err);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("sbcollide: Times may be off: ")) rest += line + '\n';
  return rest;
}

}  // namespace cli::test
