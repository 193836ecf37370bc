#pragma once
// The only file that knows the system's signals.

namespace app {

/// Makes signals that end the program, such as SIGINT and SIGTERM, call `before_end` first, in a thread of its own.
/// Those that are ignored stay ignored. A write beyond a size limit, or to a pipe that nobody reads, does not end the
/// program, but fails like one on a full disk. Call it once.
void handle_signals(void (*before_end)());

}  // namespace app
