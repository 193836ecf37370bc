#pragma once
// Reading what reports leave.

#include <map>

#include "tests/cli/process.h"

namespace cli::test {

using Row = std::map<std::string, std::string>;  // by column

/// Fails the test on a row with another number of fields than the header.
std::vector<Row> read_csv(const std::filesystem::path& file);

/// -1 if it is none, which fails the test.
double number(const std::string& text);

}  // namespace cli::test
