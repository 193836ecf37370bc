#pragma once
// The process of a guest: this program, which loads the guest's library and answers one search after another. Both
// sides share memory: room for pairs, and behind it the frame.

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "app/guest/guest.h"

namespace app::guest {

/// A search. The frame is a row of 32-bit words: x, y and z of the vertices, the first vertices of the bodies, edges,
/// triangles.
struct Request {
  std::uint32_t vertices = 0, bodies = 0, edges = 0, triangles = 0;
  float tolerance = 0;  // m
  bool forget = false;  // what it keeps of earlier frames
  double seconds = 0;   // that it may take
};

/// What the guest is, when it is loaded; then what a search has found. Texts end with 0.
struct Reply {
  std::array<char, 1024> error, key, name, summary;  // error: why it is no guest, or has found nothing; else empty
  std::uint64_t pairs;
  double ms;  // of `find`
};

/// Members throw std::runtime_error with what the guest did wrong; then it must not be asked any more.
class GuestProcess {
 public:
  /// Loads the library. words: of the largest frame.
  GuestProcess(const Guest& guest, const SharedMemory& library, std::size_t words);

  /// Returns what the guest says that it is.
  const Reply& introduction() const { return introduction_; }
  std::span<std::uint32_t> frame() const;
  Reply search(const Request& request);
  /// Returns the pairs of the last search, which the guest may still change.
  const collide::Index* pairs() const { return reinterpret_cast<const collide::Index*>(memory_.bytes().data()); }

 private:
  Reply reply(double seconds);

  const Guest& guest_;
  SharedMemory memory_;
  Process process_;
  Reply introduction_;
};

}  // namespace app::guest
