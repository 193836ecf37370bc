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

/// Returns the names of the files in a folder that a report has printed. Fails the test if it has printed more than
/// their paths.
std::set<std::string> printed_files(const Outcome& report, const std::filesystem::path& folder);

/// Returns what a report wrote to standard error, without the warning of a busy machine, which any test may meet.
std::string errors_of(const Outcome& report);

}  // namespace cli::test
