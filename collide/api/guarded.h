#pragma once
// Errors of the library, as its users get them.

#include <exception>
#include <new>
#include <string>

#include "collide/api/sbcollide/collide_c.h"
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

}  // namespace sbcollide
