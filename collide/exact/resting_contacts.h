#pragma once
// The contacts of bodies at rest, kept from one frame to the next. Neighbour lists with a skin (Verlet lists), which
// would serve moving bodies too, were measured on recorded motion and cost more than a fresh search.

#include <optional>

#include "collide/core/detector.h"
#include "collide/exact/body_broad_phase.h"

namespace collide::exact {

class RestingContacts {
 public:
  /// Compares a frame with the one before it. bounds: of all bodies of this frame, as measure_bounds() gives them. From
  /// here on until store(), group() answers for this frame; a frame that ends before store() leaves nothing to keep.
  void observe(const Frame& frame, const Settings& settings, std::span<const BodyBounds> bounds, Workers& workers);

  /// The contacts of the last frame whose first vertex is the body's, if they are those of this frame too: if neither
  /// the body nor any that is or was near it has moved since. near: of this frame.
  std::optional<std::span<const Contact>> group(Index body, const BodyBroadPhase& near) const;

  /// Keeps the result of the observed frame, if any body may be at rest in the next one.
  void store(const Frame& frame, const BodyBroadPhase& near, std::span<const Contact> contacts);

  void forget() { *this = {}; }

 private:
  // A body's positions are copied only once its box has stayed the same for a frame, so that moving bodies cost
  // nothing.
  enum class Motion : std::uint8_t {
    moving,
    copied,   // the copy holds its positions of this frame
    resting,  // the same, and they are those of the last frame
  };

  bool same_bodies(const Frame& frame, const Settings& settings) const;
  Motion observe(const VertexRun& now, const BodyBounds& bound, Index body);
  bool is_resting(Index body) const { return motion_[body] == Motion::resting; }

  float tolerance_ = 0;
  bool self_collision_ = false;
  std::vector<Index> first_;
  std::vector<std::shared_ptr<const Shape>> shape_;
  std::vector<BodyBounds> bounds_;
  std::vector<Motion> motion_;
  std::vector<float> x_, y_, z_;  // copies of positions
  bool stored_ = false;           // what follows is of the last frame
  std::vector<Contact> contacts_;
  std::vector<std::size_t> group_begin_;  // of each body in contacts_, and their end
  std::vector<Index> near_, near_begin_;  // the bodies near each body that have a greater number
};

}  // namespace collide::exact
