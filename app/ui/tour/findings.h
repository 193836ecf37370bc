#pragma once
// What the guided tour shows of one frame: two bodies, and what each step of the paper's method makes of them.

#include <memory>
#include <optional>

#include "app/compare/table_contents.h"
#include "collide/core/aabb.h"
#include "collide/methods.h"
#include "softbody/world.h"

namespace app {

struct HashedCorner {
  glm::vec3 at;  // m
  Cell cell;
  std::uint32_t bucket;
};

/// Of the paper's method on the positions, whichever method drives.
struct Findings {
  // A pair in contact if there is one, also within one body (then `other` is `body`), else a body and its nearest one.
  softbody::BodyId body = 0, other = 0;
  bool touching = false;
  std::array<collide::Aabb, 2> bounds{};  // of both

  collide::DebugGeometry structure;
  TableContents table;
  std::vector<collide::Index> boxes;        // of the body
  collide::Index box = 0;                   // of them, the one whose corners are hashed
  std::array<HashedCorner, 8> corners{};    // its corner points
  std::size_t corner = 0;                   // of them, the one whose bucket is the most telling
  std::optional<collide::Contact> closest;  // vertices of the pair, `a` being the body's; none if it is alone
  float distance = 0;                       // m, between them
  std::vector<collide::Contact> contacts;   // of the pair, all that there are
  /// Of these, what the paper's method does not find; nothing if that would take too long to find out.
  std::optional<std::vector<collide::Contact>> missed;

  collide::Counters work;        // of the whole frame
  bool predicted_tests = false;  // the frame is too large to count the pair tests: they are an estimate
};

/// Detectors of its own find it all anew for each state.
class Finder {
 public:
  Finder();
  /// wish: a body that should be in the pair, if possible. eye: from where it should be seen, if possible. Nothing if
  /// no body of the world is finite. May throw what detectors throw.
  std::optional<Findings> find(const softbody::World& world, std::optional<softbody::BodyId> wish,
                               std::optional<glm::dvec3> eye = std::nullopt);

 private:
  std::optional<std::vector<collide::Contact>> missed_by_themselves(const softbody::World& world, const Findings& f);

  std::unique_ptr<collide::Detector> exact_, paper_;
  collide::Workers alone_{1};
};

}  // namespace app
