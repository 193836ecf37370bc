#pragma once
// The interface of every detector, and the plain values that go in and come out.

#include <compare>
#include <string>
#include <string_view>

#include "collide/frame.h"
#include "collide/workers.h"

namespace collide {

inline constexpr int max_levels = 15;
inline constexpr std::uint32_t max_buckets = 1u << 24;
/// m. Squares of these and of all tolerances between them are normal floats: beyond, they would lose contacts.
inline constexpr float least_tolerance = 1e-18f, most_tolerance = 1e18f;
/// Teschner et al. 2003 with their composite 19349663 replaced by a prime.
inline constexpr std::array<std::uint32_t, 3> default_primes{73856093, 19349669, 83492791};

/// Settings of a detection. A method ignores those that it has no use for.
struct Settings {
  float tolerance = 0.1f;        // m, least_tolerance .. most_tolerance: closer vertices are in contact (§2.3)
  bool self_collision = true;    // also pairs of one body (§2.4)
  int levels = 3;                // 0 .. max_levels; a body's box is cut into 2^levels boxes (§2.1)
  std::uint32_t buckets = 1001;  // 1 .. max_buckets: the paper's "bucket size" (§2.2)
  glm::vec3 cell_size{1.0f};     // m, finite and > 0: the paper's length, height, width; see default_cell_size()
  std::array<std::uint32_t, 3> primes = default_primes;  // > 0

  bool operator==(const Settings&) const = default;
};

/// Empty if the settings are usable, else one line that names the setting, its value and what is allowed.
std::string problem(const Settings& settings);

/// Empty, or one line that says which primes are 0 or equal modulo the bucket count and so lose an axis or mix two.
std::string hash_warning(const Settings& settings);

/// Default cell size (§2.2): along each axis the largest box that `levels` midpoint cuts leave of any
/// body of the frame, plus the tolerance. A default, no guarantee of full recall. Never 0.
glm::vec3 default_cell_size(const Frame& frame, int levels, float tolerance);

/// A pair of vertices, a < b, counted over the whole frame.
struct Contact {
  Index a, b;
  auto operator<=>(const Contact&) const = default;
};

struct Counters {
  std::uint64_t hashes = 0;          // evaluations of the hash function really done
  std::uint64_t boxes = 0;           // non-empty subdivided boxes (or body boxes, for methods without levels)
  std::uint64_t pair_tests = 0;      // distances evaluated
  std::uint64_t buckets_used = 0;    // buckets with at least one entry
  std::uint64_t longest_bucket = 0;  // entries of the fullest bucket
};

/// Work that a frame did not need. Each kind is left out on a proof, so that the contacts stay the same.
enum class Skip {
  far_pairs,        // pairs of bodies whose boxes are out of reach of each other
  separated_pairs,  // pairs of bodies with near boxes, but a plane or two spheres part them
  lone_bodies,      // bodies that no other body is near: no pair pass at all
  unfolded_bodies,  // bodies that cannot touch themselves: no self pass
  kept_pairs,       // pairs of near bodies of which neither has moved: their contacts are kept, not found again
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

/// What §2.2 promises of the settings on this frame.
enum class Coverage {
  exact,     // the method cannot miss a contact (green)
  covered,   // literal, no box exceeds a cell: only contacts across a cell face can be lost (amber)
  exceeded,  // literal, a box exceeds a cell: corners skip cells (red)
};

struct Result {
  std::vector<Contact> contacts;    // ascending, no duplicates
  std::uint64_t self_contacts = 0;  // how many of them lie inside one body
  Counters counters;
  Skipped skipped{};  // all 0 for a method that leaves nothing out
  std::uint64_t& skip(Skip kind) { return skipped[static_cast<std::size_t>(kind)]; }
  Coverage coverage = Coverage::exact;
  std::vector<Index> non_finite_bodies;  // bodies with a NaN or infinite coordinate: left out, named here, ascending

  /// For a new frame: all but the contacts, which a method overwrites.
  void start() {
    self_contacts = 0;
    counters = {};
    skipped = {};
    coverage = Coverage::exact;
    non_finite_bodies.clear();
  }
};

struct BucketLoad {
  std::uint32_t bucket, load;  // load: entries
  auto operator<=>(const BucketLoad&) const = default;
};

/// A detector's inner picture, for drawing. Filled only on request.
struct DebugGeometry {
  struct Box {
    glm::vec3 lo, hi;
    Index body;
  };
  struct Cell {
    std::array<std::int64_t, 3> index;  // covers [index * cell_size, (index + 1) * cell_size) along each axis
    std::uint32_t bucket;
    auto operator<=>(const Cell&) const = default;
  };
  std::vector<Box> boxes;                   // as the method hashes them, or where it looks for contacts
  std::vector<Index> vertices;              // those that it hashes one by one, if it does
  std::vector<std::uint32_t> box_first{0};  // boxes.size() + 1 offsets into box_bucket
  std::vector<std::uint32_t> box_bucket;    // the buckets that each box is in, in the order it was hashed: the first
                                            // is that of its minimum corner (§2.2)
  std::vector<Cell> cells;                  // occupied cells, ascending, no duplicates; at most debug_cell_limit
  std::uint32_t buckets = 0;                // of the table; 0 if the method hashes nothing
  std::vector<BucketLoad> loads;            // of those that are used, each once, in any order
  static constexpr std::size_t debug_cell_limit = 200'000;
};

/// Finds the contacts of one frame after another. Keeps scratch memory and, where a method reuses it, what it learnt
/// from earlier frames; bodies may come and go between frames. Deterministic: the result does not depend on workers.
class Detector {
 public:
  virtual ~Detector() = default;
  /// settings must have no problem(). Throws std::length_error if the method would need more memory than it may take.
  virtual void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) = 0;
  /// Drops all that was learnt from earlier frames and keeps the scratch memory: the next frame is found from scratch.
  virtual void forget() {}
  /// The picture of the last detect(); empty for methods that build no boxes and no table.
  virtual DebugGeometry debug() const { return {}; }
};

}  // namespace collide
