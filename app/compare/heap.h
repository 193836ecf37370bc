#pragma once

#include <cstddef>

namespace app {

/// Bytes that the program has allocated and not given back; 0 where the C library does not tell (only glibc does, and
/// not under a sanitizer). Small blocks that the allocator keeps at hand for reuse count as well, so a difference is
/// true to some KiB, and only as long as no other thread allocates.
std::size_t heap_in_use();

}  // namespace app
