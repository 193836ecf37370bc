#include "app/base/streams.h"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "app/base/usage_error.h"

namespace app {

void flush_standard_output() {
  if (!std::cout.flush() || std::fflush(stdout) != 0)
    throw UsageError("standard output cannot be written to; is the disk full, or did its reader end?");
}

void show_progress(const std::string& text) {
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r%-60s", text.c_str());
}

void clear_progress() {
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r%60s\r", "");
}

}  // namespace app
