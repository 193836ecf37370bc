#pragma once
// Finds which vertices of bodies are closer than a tolerance:
//
//   sbcollide::ContactFinder finder({.tolerance = 0.01f});
//   finder.add_body({.vertices = 8, .triangles = triangles});
//   for (const sbcollide::Contact& c : finder.find(x, y, z).contacts) use(c.a, c.b);
//
// There is no global state: finders may work on several threads at the same time, each on one of them. A function that
// throws leaves its object as it was, but for the result of find(), which is then empty.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <sbcollide/contact.h>
#include <sbcollide/error.h>
#include <sbcollide/version.h>

namespace sbcollide {

struct FinderSettings {
  std::string method = "multi-level-sb-exact";  // see method_keys()
  float tolerance = 0.1f;                       // closer vertices are in contact; in the unit of the positions
  bool self_collision = true;                   // pairs of one body count, too
  int threads = 1;                              // 0: all cores. The result does not depend on it
  // Of use to some methods only:
  int levels = 3;                       // a body's box is cut into 2^levels boxes
  std::uint32_t buckets = 1001;         // of the hash table
  std::array<float, 3> cell_size = {};  // of a cell; all 0: the largest box of bodies at rest, else of the first frame
};

/// Returns the keys of all methods. "brute-force" is the reference, and "multi-level-sb" can miss contacts.
std::vector<std::string> method_keys();

/// The mesh of a body. Within one body, no pair of vertices counts that an edge or a side of a triangle joins, or that
/// is closer than the tolerance at rest. Vertices count from 0 in each body.
struct BodyMesh {
  Index vertices = 0;
  std::span<const std::array<Index, 3>> triangles = {};
  std::span<const std::array<Index, 2>> edges = {};  // further ones, or those of polygons
  std::span<const float> rest = {};                  // x, y, z of each vertex at rest; empty: not known
};

/// What find() has found. The spans are valid until the next call of a function of the finder.
struct Detection {
  std::span<const Contact> contacts;         // ascending, no duplicates
  std::uint64_t self_contacts = 0;           // how many of them lie inside one body
  std::span<const Index> non_finite_bodies;  // bodies with a NaN or infinite coordinate: left out; ascending
  bool complete = true;                      // false for a method that can miss contacts
  std::uint64_t pair_tests = 0;              // distances evaluated
};

class ContactFinder {
 public:
  /// Throws Error if a setting is not allowed.
  explicit ContactFinder(const FinderSettings& settings = {});
  ~ContactFinder();
  ContactFinder(ContactFinder&&) noexcept;
  ContactFinder& operator=(ContactFinder&&) noexcept;

  /// Changes the settings, keeps the bodies, and forgets the frame before. Throws Error if a setting is not allowed.
  void configure(const FinderSettings& settings);

  /// Adds a body after all others, and returns its number. Copies the mesh. Throws Error if the mesh names a vertex
  /// that it does not have, or if the rest positions are not one for each vertex.
  Index add_body(const BodyMesh& mesh);
  void clear_bodies();
  Index bodies() const;
  Index vertices() const;  // of all bodies
  /// Returns the body of a vertex. Throws Error if there is no such vertex.
  Index body_of(Index vertex) const;

  /// Finds the contacts at these positions: one coordinate for each vertex of all bodies, in their order. It reads them
  /// where they are. A finder remembers the frame before, which may save work and never changes the result. Throws
  /// Error if there are too few or too many of them, or too many contacts (2^27).
  Detection find(std::span<const float> x, std::span<const float> y, std::span<const float> z);
  /// Finds them at positions that are written x, y, z, x, y, z ...; it copies them.
  Detection find(std::span<const float> xyz);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sbcollide
