#pragma once
// The example of the guided tour: two bodies of one frame, and what each step of the paper's method does with them.

#include <array>
#include <memory>
#include <optional>

#include "app/compare/table_contents.h"
#include "collide/core/aabb.h"
#include "collide/methods.h"
#include "softbody/world.h"

namespace app::ui {

struct HashedCorner {
  glm::vec3 at;  // m
  compare::Cell cell;
  std::uint32_t bucket;
};

/// The paper's method on one frame, whichever method drives.
struct TourExample {
  // A pair in contact if there is one (if the contact is inside one body, `other` is `body`); else a body and the one
  // nearest to it.
  softbody::BodyId body = 0, other = 0;
  bool touching = false;
  std::array<collide::Aabb, 2> bounds{};  // of `body` and `other`

  collide::DebugGeometry structure;
  compare::TableContents table;
  std::vector<collide::Index> boxes;        // of the body
  collide::Index box = 0;                   // the one of these whose corners are hashed
  std::array<HashedCorner, 8> corners{};    // of this box
  std::size_t corner = 0;                   // the one of these that the tour shows first
  std::optional<collide::Contact> closest;  // vertices of the pair, `a` is the body's; nothing if the body is alone
  float distance = 0;                       // m, between these vertices
  std::vector<collide::Contact> contacts;   // all contacts of the pair
  /// Those of `contacts` that the paper's method misses; nothing if it would take too long to find out.
  std::optional<std::vector<collide::Contact>> missed;

  collide::Counters work;             // of the whole frame
  bool pair_tests_estimated = false;  // the frame is too large to count its pair tests
};

/// Finds examples with detectors of its own, without using what the driving method has found.
class ExampleFinder {
 public:
  ExampleFinder();
  /// Returns nothing if no body of the world is finite. Prefers a pair with the body `preferred`, and one that is
  /// visible from `eye`. May throw what detectors throw.
  std::optional<TourExample> find(const softbody::World& world, std::optional<softbody::BodyId> preferred,
                                  std::optional<glm::dvec3> eye = std::nullopt);

 private:
  std::optional<std::vector<collide::Contact>> missed_of_pair(const softbody::World& world, const TourExample& example);

  std::unique_ptr<collide::Detector> exact_, paper_;
  collide::Workers one_worker_{1};
};

}  // namespace app::ui
