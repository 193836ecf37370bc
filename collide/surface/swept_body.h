#pragma once
// Predicts the motion of one body for a while: swept boxes around its features, bounds of their speeds, and whether the
// body can touch itself in that time.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "collide/core/aabb.h"
#include "collide/surface/patch_boxes.h"

namespace collide::surface {

/// Positions and velocities at one instant: one value for each vertex of all bodies.
struct Motion {
  Frame positions;                    // m
  std::span<const float> vx, vy, vz;  // m/s
};

/// What the search knows of a body. The contact offset of a body is skin - slack: two features are within their contact
/// distance if they are no farther apart than the sum of their bodies' contact offsets.
struct SurfaceBody {
  const Surface* surface = nullptr;
  float skin = 0;       // m: contact offset + slack; swept boxes are grown by this much
  float slack = 0;      // m: the largest deviation from the predicted path for which the prediction is valid
  float mean_edge = 0;  // m, of the rest shape
  bool moves = false;   // pairs of two bodies that do not move are left out
  // s: the motion is predicted for at most this long. Choose a short one for a body that will soon leave its path.
  float horizon = std::numeric_limits<float>::infinity();
};

struct MovingPoint {
  glm::vec3 at;        // m
  glm::vec3 velocity;  // m/s
};

/// Predicts that each vertex moves on a straight path, x + v t, from which it deviates by at most the slack. All times
/// are in seconds since one common instant.
class SweptBody {
 public:
  /// Predicts the motion from `begin` to `end`. The prediction ends earlier, but not within min_seconds, when
  /// deformation may have moved a vertex by half an edge: boxes that are swept farther overlap most others of their
  /// body, and it is cheaper to predict again. Precondition: the surface has as many vertices as the body.
  void predict(const Motion& now, Index body, const SurfaceBody& traits, float begin, float end, float min_seconds);
  /// Ends the prediction earlier, but not within min_seconds: when deformation may have moved a vertex by `way` (m).
  /// Precondition: live().
  void limit_deformation(float way, float min_seconds);
  /// Returns true if the body has vertices and a surface, and all positions and velocities are finite.
  bool live() const { return live_; }
  const Surface& surface() const { return *traits_.surface; }
  bool moves() const { return traits_.moves; }
  float begin() const { return begin_; }
  float end() const { return end_; }

  /// Return the box around the swept body, grown by the skin: in the body's frame, which coincides with the
  /// world's at begin() and moves with the mean velocity; and in the world.
  const Aabb& local_box() const { return local_box_; }
  const Aabb& world_box() const { return world_box_; }
  /// Computes the swept boxes of all features in the body's frame, grown by the skin. Precondition: live().
  void build_feature_boxes();
  /// Computes where the vertices are at `time`.
  void place_points(float time);
  const PatchBoxes& vertex_boxes() const { return vertex_boxes_; }
  const PatchBoxes& face_boxes() const { return face_boxes_; }
  const PatchBoxes& edge_boxes() const { return edge_boxes_; }
  /// Returns the vertices as the last place_points() placed them.
  const std::vector<MovingPoint>& points() const { return points_; }
  /// Returns how far (m) the mean velocity has carried the body from begin() to `time`.
  glm::vec3 drift(float time) const { return (time - begin_) * mean_velocity_; }
  glm::vec3 mean_velocity() const { return mean_velocity_; }
  float velocity_spread() const { return velocity_spread_; }              // m/s: largest |v - mean velocity|
  float max_deformation_speed() const { return max_deformation_speed_; }  // m/s: largest of deforming_points()
  const PatchBoxes::Columns& start() const { return start_; }             // m, where the vertices are at begin()
  VertexRun run() const { return {start_[0].data(), start_[1].data(), start_[2].data(), count_}; }
  glm::vec3 at(Index v) const { return {start_[0][v], start_[1][v], start_[2][v]}; }
  glm::vec3 velocity(Index v) const { return {velocity_[0][v], velocity_[1][v], velocity_[2][v]}; }
  glm::vec3 at(Index v, float time) const { return at(v) + (time - begin_) * velocity(v); }
  /// Returns the vertices at begin(), with their velocities minus the rigid motion of the body.
  const std::vector<MovingPoint>& deforming_points() const { return deforming_points_; }

  /// Returns true if the surface is closed and star-shaped around its centre, and stays so until end(): then the body
  /// cannot touch itself. Precondition: live().
  bool stays_star_shaped() const;
  /// Measures how far the vertices are from their predicted paths at `time`, and marks the prediction as expired if
  /// that exceeds the slack or if the prediction ends before `until`.
  void update_deviation(const Frame& now, Index body, float time, float until);
  float deviation() const { return deviation_; }  // m: the largest that was measured since begin()
  /// Returns until when the deviation stays within the slack, if it grows with the square of the time since begin(), as
  /// under a constant acceleration. Infinite before the first update_deviation().
  float holds_until() const { return holds_until_; }
  bool exceeds_slack() const { return !(deviation_ <= traits_.slack); }
  bool expired() const { return expired_; }
  /// Sets deviation() and begin() to those of an earlier prediction.
  void restore(float deviation, float begin) { deviation_ = deviation, begin_ = begin; }

 private:
  void fit_rigid_motion();
  void bound_velocities();
  void bound_path();

  SurfaceBody traits_;
  float begin_ = 0, end_ = 0;
  bool live_ = false, expired_ = false;
  Index count_ = 0;
  std::array<std::vector<float>, 3> start_, velocity_;     // m and m/s, of each vertex; 0 m/s if the body does not move
  glm::vec3 mean_velocity_{0.0f};                          // m/s
  glm::vec3 centre_{0.0f}, spin_{0.0f};                    // m; 1/s, about the centre
  float velocity_spread_ = 0, max_deformation_speed_ = 0;  // m/s
  float deviation_ = 0;                                    // m
  float holds_until_ = std::numeric_limits<float>::infinity();
  Aabb local_box_{}, world_box_{};
  PatchBoxes vertex_boxes_, face_boxes_, edge_boxes_;
  std::vector<MovingPoint> points_, deforming_points_;
};

}  // namespace collide::surface
