#pragma once

#include <cstddef>

namespace app::compare {

/// Returns the bytes that the program has allocated and not freed; 0 if the C library does not report them (only glibc
/// does, and not under a sanitizer). Small blocks that the allocator keeps for reuse count, too. Hence a difference is
/// accurate to some KiB, and only while no other thread allocates.
std::size_t heap_in_use();

}  // namespace app::compare
