#pragma once
// The example of the guided tour: two bodies of one frame, and what each step of the paper's method does with them.

#include <array>
#include <memory>
#include <optional>

#include "app/ui/tour/miss.h"
#include "app/ui/tour/paper_boxes.h"
#include "collide/core/aabb.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::ui {

/// The work of the paper's method on a whole frame.
struct FrameWork {
  std::uint64_t bodies = 0, vertices = 0, boxes = 0, hashes = 0, pair_tests = 0;
  std::uint64_t all_pairs = 0;        // the pair tests of brute force
  bool pair_tests_estimated = false;  // the frame is too large to count them
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
  collide::Range boxes{};                 // of the body
  collide::Index box = 0;                 // the one of these whose corners are hashed
  std::array<HashedCorner, 8> corners{};  // of this box
  std::size_t corner = 0;                 // the one of these that the tour shows first
  /// If these corners share no bucket with another cell: a corner that does, of the pair's boxes or else of any.
  std::optional<HashedCorner> aliased_corner;
  std::optional<collide::Contact> closest;  // vertices of the pair, `a` is the body's; nothing if the body is alone
  float distance = 0;                       // m, between these vertices
  std::vector<collide::Contact> contacts;   // all contacts of the pair
  std::vector<collide::Contact> missed;     // those of `contacts` that the paper's method misses

  // Of the whole frame.
  std::size_t all_contacts = 0, all_missed = 0;
  std::optional<ExplainedMiss> miss;  // one of the pair if there is one, else one of another pair
  FrameWork work;
};

/// Finds examples with detectors of its own, without using what the driving method has found. All functions may throw
/// what detectors throw.
class ExampleFinder {
 public:
  ExampleFinder();
  /// Returns nothing if no body of the world is finite. Prefers a pair with the body `preferred`, and one that is
  /// visible from `eye`.
  std::optional<TourExample> find(const softbody::BodiesInMotion& world, std::optional<softbody::BodyId> preferred,
                                  std::optional<glm::dvec3> eye = std::nullopt);
  bool has_contact(const softbody::BodiesInMotion& world);
  bool has_miss(const softbody::BodiesInMotion& world);

 private:
  std::vector<collide::Contact> true_contacts(const softbody::BodiesInMotion& world);
  FrameWork count_work(const softbody::BodiesInMotion& world, std::size_t boxes);

  std::unique_ptr<collide::Detector> exact_, paper_;
  collide::methods::PaperStructure paper_structure_ = collide::methods::make_paper_structure();
  collide::Workers one_worker_{1};
};

}  // namespace app::ui
