#pragma once
// Reads what reports write.

#include <map>

#include "tests/cli/process.h"

namespace cli::test {

using Row = std::map<std::string, std::string>;  // by column

/// Reads all rows. Fails the test if a row has another number of fields than the header.
std::vector<Row> read_csv(const std::filesystem::path& file);

/// Returns the number; fails the test and returns -1 if the text is none.
double number(const std::string& text);

}  // namespace cli::test
