#pragma once
// The heap of the C library.

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace app {

/// Returns the bytes that the program has allocated and not freed; 0 if the C library does not report them (only glibc
/// does, and not under a sanitizer). Small blocks that the allocator keeps for reuse count, too. Hence a difference is
/// accurate to some KiB, and only while no other thread allocates.
inline std::size_t heap_in_use() {
#ifdef __GLIBC__
  const struct mallinfo2 heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;  // in the arenas; large blocks with mappings of their own
#else
  return 0;
#endif
}

/// Gives freed memory back to the system where the C library keeps it. Takes some milliseconds.
inline void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace app
