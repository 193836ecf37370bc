#pragma once
// Embree: a bounding volume hierarchy over boxes that move, collided with itself. What both uses of it share.

#include <embree3/rtcore.h>

#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "collide/core/detector.h"

namespace bench {

/// What the callbacks find, on several threads at a time.
class EmbreeContacts {
 public:
  /// The list of the calling thread.
  std::vector<collide::Contact>& local() { return lists_.local(); }
  /// Appends all lists and empties them.
  void append_to(std::vector<collide::Contact>& contacts);

 private:
  using List = std::vector<collide::Contact>;
  tbb::enumerable_thread_specific<List, tbb::cache_aligned_allocator<List>, tbb::ets_key_per_instance> lists_;
};

class EmbreeScene {
 public:
  /// The way the hierarchy follows the boxes from frame to frame.
  enum class Update { rebuild, refit };

  explicit EmbreeScene(Update update) : update_(update) {}
  ~EmbreeScene() { release(); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Brings the hierarchy up to date with `count` boxes. bounds is called with `user` for each of them. Throws
  /// std::runtime_error if Embree refuses.
  void update(std::size_t count, int threads, RTCBoundsFunction bounds, void* user);

  /// Calls keep(user, pairs, number) with the pairs of boxes that may overlap, each in both orders; with more than
  /// one thread on several at a time.
  void collide(RTCCollideFunc keep, void* user) const { rtcCollide(scene_, scene_, keep, user); }

 private:
  void start(std::size_t count, int threads);
  void release();

  const Update update_;
  std::size_t count_ = 0;
  int threads_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;
};

}  // namespace bench
