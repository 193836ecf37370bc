#pragma once
// The contacts inside bodies and between two of them, by their patches. All threads share the groups of patches of one
// body.

#include <mutex>
#include <unordered_map>

#include "collide/core/detector.h"
#include "collide/exact/patched_shape.h"

namespace collide::exact {

/// Shapes are cut into patches once; a frame moves the boxes around them. Patches that are near each other in the shape
/// are always tested, but only those of their vertices that can be in contact at all; others if their boxes are near.
/// The test is one in bytes, which lets all contacts pass: see ByteUnit. squared_distance() decides.
class PatchSearch {
 public:
  /// Starts a frame. cutoff: m.
  void begin(float tolerance2, float cutoff);

  /// Takes the positions of the bodies of some pairs, of which some may be pairs inside a body, and shares the pairs
  /// among threads. Returns how many tasks the caller should deal.
  std::size_t take(const Frame& frame, std::span<const std::array<Index, 2>> pairs, int threads, Workers& workers);

  /// The memory of a thread.
  struct Scratch {
    Patches patches;
    GroupHits hits;
    std::vector<DebugGeometry::Box> boxes;  // of the patches of any two bodies: find() appends them
  };
  struct Found {
    std::uint64_t pair_tests = 0, self_contacts = 0;
  };
  /// Appends the contacts of a task; in no order. Throws std::length_error if `contacts` grows beyond max_contacts.
  Found find(std::size_t task, std::size_t max_contacts, Scratch& scratch, std::vector<Contact>& contacts) const;

  /// Does the same for the contacts of any two bodies, or inside a body. Several threads may call it at once.
  Found find(const Frame& frame, Index a, Index b, std::size_t max_contacts, Scratch& scratch,
             std::vector<Contact>& contacts);

  std::size_t patches() const;
  /// Appends the boxes of the patches, for drawing.
  void add_boxes(std::vector<DebugGeometry::Box>& boxes) const;
  /// Drops the cuts that were taken from frames. Those of rest shapes stay.
  void forget();

 private:
  struct Body {
    PatchedShape* cut;
    const Shape* shape;
    Index body, first_vertex, first_group;

    Range groups() const { return {first_group, first_group + cut->groups()}; }
    Range patches() const { return {first_group * Patches::size, first_group * Patches::size + cut->patches()}; }
  };
  struct Task {
    const Body *a, *b;
    Range groups;  // of a
  };
  Body lay_out(const Frame& frame, Index body, Index first_group, bool self);
  void fill(const Frame& frame, Workers& workers);
  void fill(const Frame& frame, const Body& body, Range groups, Patches& patches) const;
  bool cut_spread_shapes(const Frame& frame);
  Found find(const Task& task, const Patches& patches, std::size_t max_contacts, GroupHits& hits,
             std::vector<Contact>& contacts) const;
  static void add_boxes(const Body& body, const Patches& patches, std::vector<DebugGeometry::Box>& boxes);
  void add_contacts(const Task& task, std::span<const std::array<Index, 2>> pairs, bool known,
                    std::vector<Contact>& contacts) const;

  float tolerance2_ = 0, cutoff_ = 0;
  ByteUnit unit_{1};
  std::mutex mutex_;  // of cuts_
  std::unordered_map<const Shape*, PatchedShape> cuts_;
  std::vector<Body> bodies_;
  Patches patches_;
  std::vector<Task> tasks_;
};

}  // namespace collide::exact
