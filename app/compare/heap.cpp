#include "app/compare/heap.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace app::compare {

std::size_t heap_in_use() {
#if defined(__GLIBC__)
  const struct mallinfo2 heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;  // in the arenas; large blocks with mappings of their own
#else
  return 0;
#endif
}

}  // namespace app::compare
