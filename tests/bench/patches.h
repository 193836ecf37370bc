#pragma once
// Bodies cut into patches of neighbouring vertices. A library gets a box around each patch; patches whose boxes overlap
// are tested here, all pairs of vertices side by side. Patches of one vertex are the plain use of a library; larger
// ones give it fewer boxes.

#include <array>

#include "tests/bench/contact_list.h"

namespace bench {

struct Box {
  std::array<float, 3> lo, hi;  // m
};

/// Width: most vertices of a patch: 8 or 16.
template <collide::Index Width>
class Patches {
 public:
  /// Takes the positions of a frame. The cuts are made once for bodies that stay, on their first positions. Boxes are
  /// padded so that two of them overlap where two vertices of theirs are in contact.
  void update(const collide::Frame& frame, float tolerance);

  collide::Index count() const { return static_cast<collide::Index>(slots_.size()); }
  const Box& box(collide::Index patch) const { return boxes_[patch]; }
  collide::Index body(collide::Index patch) const { return slots_[patch].body; }

  /// Appends the contacts between two patches.
  void test(collide::Index p, collide::Index q, const ContactFilter& filter,
            std::vector<collide::Contact>& contacts) const;
  /// Appends the contacts inside each patch, which no library names.
  void test_insides(const ContactFilter& filter, std::vector<collide::Contact>& contacts) const;

 private:
  /// One patch; lanes beyond `size` hold a NaN, which is close to nothing.
  struct Slots {
    alignas(Width * sizeof(float)) std::array<std::array<float, Width>, 3> position;
    std::array<collide::Index, Width> vertex;
    collide::Index size, body;
  };
  void cut(const collide::Frame& frame, collide::Index body, std::span<collide::Index> vertices);
  void add(collide::Index body, std::span<const collide::Index> vertices);

  std::vector<collide::Index> first_;
  std::vector<Slots> slots_;
  std::vector<Box> boxes_;
};

}  // namespace bench
