#pragma once
// What a body may sweep while it moves on for a while: boxes around its features, bounds of their speeds, and whether
// it can touch itself meanwhile.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "collide/core/vertex_run.h"
#include "collide/surface/box_pairs.h"
#include "collide/surface/surface.h"

namespace collide::surface {

/// What moves, seen at one instant: one value a vertex, over all bodies.
struct Motion {
  Frame positions;                    // m
  std::span<const float> vx, vy, vz;  // m/s
};

struct SurfaceBody {
  const Surface* surface = nullptr;
  float skin = 0;      // m: reach and slack
  float slack = 0;     // m
  float edge = 0;      // m, the mean at rest
  bool moves = false;  // pairs of which neither does are left out
  // s: its motion is foreseen for no longer. What will be thrown off its path soon had best be looked at often.
  float foresight = std::numeric_limits<float>::infinity();
};

/// Vertices go straight on from where they are seen, x + v t, and stray from that by no more than the slack. Times are
/// in seconds, from any one start.
class SweptBody {
 public:
  /// Until `end`, or until a vertex has been strained half an edge: what sweeps over more of itself meets all of
  /// itself, far oftener than it is worth to look again. For the seconds `least` in any case.
  void foresee(const Motion& now, Index body, const SurfaceBody& traits, float begin, float end, float least);
  /// Has something, and nothing that is not finite.
  bool live() const { return live_; }
  const Surface& surface() const { return *traits_.surface; }
  bool moves() const { return traits_.moves; }
  float begin() const { return begin_; }
  float end() const { return end_; }

  /// Around all that it sweeps, each grown by the skin: seen from the body, as it flies with its mean velocity from
  /// where it is at begin(), or from the world.
  const Aabb& box() const { return box_; }
  const Aabb& world() const { return world_; }
  /// Finds the boxes of its features, seen from the body.
  void box_features();
  const BoxList& vertices() const { return vertices_; }
  const BoxList& faces() const { return faces_; }
  const BoxList& edges() const { return edges_; }
  /// Boxes of its vertices that overlap if two of them come within reach of each other, however the body flies and
  /// turns. See the proof in surface_search.h.
  void box_strained(BoxList& vertices) const;

  /// m: where the mean velocity has taken it at a time.
  glm::vec3 drift(float time) const { return (time - begin_) * mean_; }
  glm::vec3 mean_velocity() const { return mean_; }
  float spread() const { return spread_; }            // m/s: no vertex differs more from the mean velocity
  float most_strain() const { return most_strain_; }  // m/s, nor from the rigid motion
  VertexRun run() const { return {start_[0].data(), start_[1].data(), start_[2].data(), count_}; }
  glm::vec3 at(Index v) const { return {start_[0][v], start_[1][v], start_[2][v]}; }
  glm::vec3 velocity(Index v) const { return {velocity_[0][v], velocity_[1][v], velocity_[2][v]}; }
  glm::vec3 at(Index v, float time) const { return at(v) + (time - begin_) * velocity(v); }
  /// m/s: what is left of a vertex's velocity without the body's rigid motion.
  glm::vec3 strain(Index v) const { return velocity(v) - mean_ - glm::cross(spin_, at(v) - centre_); }

  /// Whether it is closed and star-shaped, seen from its middle, and stays so: then it cannot touch itself.
  bool unfolded() const;
  /// Looks how far its vertices are off their paths at a time, and whether that will do until another.
  void look(const Frame& now, Index body, float time, float until);
  float stray() const { return stray_; }  // m: the farthest that was seen since begin()
  bool strayed() const { return !(stray_ <= traits_.slack); }
  bool due() const { return due_; }  // it has strayed, or has not been foreseen for as long
  /// Says how far it has strayed, from a motion that was foreseen at `begin`.
  void recall(float stray, float begin) { stray_ = stray, begin_ = begin; }

 private:
  void find_rigid_motion();
  void find_bounds(float least);

  SurfaceBody traits_;
  float begin_ = 0, end_ = 0;
  bool live_ = false, due_ = false;
  Index count_ = 0;
  std::array<std::vector<float>, 3> start_, velocity_;  // m and m/s, of each vertex; no velocity if it stands
  glm::vec3 mean_{0.0f};                                // m/s
  glm::vec3 centre_{0.0f}, spin_{0.0f};                 // m; 1/s, about the centre
  float spread_ = 0, most_strain_ = 0;                  // m/s
  float stray_ = 0;                                     // m
  Aabb box_{}, world_{};
  BoxList vertices_, faces_, edges_;
};

/// The boxes around features, given those of their vertices.
void join(const BoxList& vertices, const std::vector<Triangle>& features, BoxList& list);
void join(const BoxList& vertices, const std::vector<Edge>& features, BoxList& list);

}  // namespace collide::surface
