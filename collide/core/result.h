#pragma once
// What a detection returns: contacts, counters, and the work that it left out.

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "collide/api/sbcollide/contact.h"
#include "collide/core/frame.h"

namespace collide {

/// A pair of vertices a < b, numbered over the whole frame. The type of the public headers, so that they copy nothing.
using sbcollide::Contact;

/// The most contacts of one frame: 1 GiB of them.
inline constexpr std::size_t contact_limit = std::size_t{1} << 27;

/// Throws the std::length_error of a frame with more contacts than `limit`.
[[noreturn]] inline void throw_too_many_contacts(std::size_t limit) {
  throw std::length_error("more than " + std::to_string(limit) + " contacts in one frame: lower the tolerance");
}

struct Counters {
  std::uint64_t hashes = 0;      // evaluations of the hash function
  std::uint64_t boxes = 0;       // non-empty subdivided boxes (or body boxes, for methods without levels)
  std::uint64_t pair_tests = 0;  // distances evaluated
};

/// Kinds of work that a frame did not need. Each is left out because of a proof, so the contacts are the same.
enum class Skip {
  far_pairs,        // pairs of bodies whose boxes are farther apart than the cutoff
  separated_pairs,  // pairs of bodies with near boxes that a plane or the bounding spheres separate
  lone_bodies,      // bodies that are near no other body
  unfolded_bodies,  // bodies that cannot touch themselves
  kept_pairs,       // pairs of near bodies that have not moved: their contacts are kept
};
struct SkipKind {
  std::string_view key;   // in JSON
  std::string_view text;  // in the panel, after a number: "3 pairs of far bodies"
};
inline constexpr std::array<SkipKind, 5> skip_kinds{{{"far_pairs", "pairs of far bodies"},
                                                     {"separated_pairs", "pairs parted by a plane or spheres"},
                                                     {"lone_bodies", "bodies alone"},
                                                     {"unfolded_bodies", "bodies that cannot touch themselves"},
                                                     {"kept_pairs", "pairs at rest"}}};
using Skipped = std::array<std::uint64_t, skip_kinds.size()>;  // by Skip

/// What the settings guarantee on this frame (§2.2).
enum class Coverage {
  exact,     // the method cannot miss a contact (green)
  covered,   // literal, no box exceeds a cell: only contacts across a cell face can be lost (amber)
  exceeded,  // literal, a box exceeds a cell: its corners skip cells (red)
  unknown,   // a method of the user's own
};

struct Result {
  std::vector<Contact> contacts;    // ascending, no duplicates
  std::uint64_t self_contacts = 0;  // how many of them lie inside one body
  Counters counters{};
  Skipped skipped{};  // all 0 for a method that leaves out nothing
  std::uint64_t& skip(Skip kind) { return skipped[static_cast<std::size_t>(kind)]; }
  Coverage coverage = Coverage::exact;
  std::vector<Index> non_finite_bodies{};  // bodies with a NaN or infinite coordinate: left out; ascending
  std::optional<double> own_ms{};          // how long the search took, of a method that measures that itself

  /// Clears everything except the contacts, which a method overwrites.
  void start() { *this = {.contacts = std::move(contacts)}; }
};

}  // namespace collide
