#pragma once
// What the C++ and C interfaces share: errors as users get them, handles, and the number of threads.

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "collide/api/sbcollide/collide_c.h"
#include "collide/api/sbcollide/contact.h"
#include "collide/api/sbcollide/error.h"

namespace sbcollide {

/// Calls `work` and returns what it returns. Its exceptions leave as Error, but for std::bad_alloc.
template <class Work>
decltype(auto) translated(Work&& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(error.what());
  }
}

/// For functions of the C interface: calls `work`. Its exceptions become a status, and a text in handle->error.
template <class Handle, class Work>
sbcollide_status guarded(Handle* handle, Work&& work) noexcept {
  if (!handle) return SBCOLLIDE_ERROR;
  try {
    handle->error.clear();
    try {
      work();
      return SBCOLLIDE_OK;
    } catch (const Error& error) {
      handle->error = error.what();
      return SBCOLLIDE_ERROR;
    }
  } catch (...) {
    return SBCOLLIDE_OUT_OF_MEMORY;
  }
}

/// Throws Error if `given` is no pointer, though `count` elements are to be read there.
inline void require_pointer(const void* given, std::size_t count, const char* name) {
  if (!given && count > 0) throw Error(std::string(name) + ": is NULL");
}

/// Copies the `count` groups of N numbers that begin at `first`. Throws Error if `first` is no pointer.
template <std::size_t N>
std::vector<std::array<Index, N>> groups_at(const std::uint32_t* first, std::size_t count, const char* name) {
  require_pointer(first, count, name);
  std::vector<std::array<Index, N>> groups(count);
  for (std::size_t i = 0; i < N * count; ++i) groups[i / N][i % N] = first[i];
  return groups;
}

/// Makes an object of the C interface. Returns nullptr if there is no memory for it.
template <class Handle>
Handle* made() noexcept {
  try {
    return new Handle;
  } catch (...) {
    return nullptr;
  }
}

/// Returns how many threads a user's number stands for. Throws Error if it is none.
inline int threads_of(int number) {
  constexpr int most = 256;
  if (number < 0 || number > most)
    throw Error("threads: must be from 0 to " + std::to_string(most) + ", where 0 stands for all cores");
  return number > 0 ? number : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace sbcollide
