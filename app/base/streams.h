#pragma once
// Standard output that must arrive, and progress on standard error.

#include <string>

namespace app {

/// Throws UsageError if something that was printed cannot be written: standard output is closed or full.
void flush_standard_output();

/// Shows what is going on in the last line of standard error, over what was shown there before. Does nothing if
/// standard error is not a terminal.
void show_progress(const std::string& text);
/// Clears the line of show_progress().
void clear_progress();

}  // namespace app
