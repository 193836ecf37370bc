#pragma once
// What dynamics keeps of the bodies: in batches, whose bodies move in step, and from one frame to the next.

#include <array>
#include <memory>
#include <vector>

#include "softbody/contact/solid_features.h"
#include "softbody/contact/solid_law.h"
#include "softbody/contact/surface_contact.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/kernels.h"
#include "softbody/integrate/substeps.h"
#include "softbody/model/body_model.h"
#include "softbody/state/kernel_types.h"

namespace softbody {

/// Up to `width` bodies of one model. Its values start at `base` in every array of the state. What stands here for
/// each lane has room for the widest.
struct Batch {
  std::shared_ptr<const BodyModel> model;
  int width = lanes;  // or one_lane, see Dynamics::batch_with_free_lane()
  std::size_t base = 0;
  int used = 0;  // lanes taken
  std::array<BodyId, lanes> body{};
  alignas(32) std::array<float, lanes> moves{};     // 1: integrated; 0: asleep, held or an empty lane
  LaneVector impulse{};                             // N s, of solids along their normals, in the last advance()
  alignas(32) std::array<float, lanes> returned{};  // N s, the part of these impulses that restitution gives back
  unsigned contacted = 0;                           // bits: lanes that may have been pushed in the last advance()
  std::vector<SolidArguments> near_solids;          // for the frame at hand ...
  std::vector<SolidFeature> solid_features;         // ... and what of the bodies may meet them between vertices

  std::size_t particles() const { return model->mesh.vertices.size(); }
  std::size_t values() const { return particles() * std::size_t(width); }  // of one array
};

/// A batch with its positions and velocities, and the kernels of its width.
struct BatchView {
  const Batch& batch;
  const Kernels& kernels;
  Field<float> x, v;  // m and m/s
  BodyField positions(int lane) const { return {x, std::size_t(lane), std::size_t(batch.width)}; }
  BodyField velocities(int lane) const { return {v, std::size_t(lane), std::size_t(batch.width)}; }
};

struct Body {
  Index batch;
  int lane;
  std::uint32_t number = 0;  // stays when bodies before it are taken out and ids move up
  glm::dvec3 origin;         // m; particle positions are stored relative to it, so that floats stay fine far from zero
  int release = 0;           // held in place until this frame
  bool pinned = false;
  bool asleep = false;
  int calm_frames = 0;  // for how long it has been slow enough to sleep
  double impact = 0;    // m/s, speed with which it came upon the solids that it touches
  bool moves() const { return !pinned && !asleep; }
};

inline std::size_t bytes_of(const auto& list) { return list.size() * sizeof(list[0]); }

/// All that bodies remember from one frame to the next.
struct DynamicsState {
  std::vector<Batch> batches;
  std::vector<Body> bodies;
  std::array<LaneArray<float>, 3> x, v;  // m and m/s, as Dynamics stores them
  float penalty_thickness = 0;           // m
  std::vector<PenaltyPair> penalty_pairs;
  SurfaceContact::State surface;
  SubstepHysteresis substep_hysteresis;

  std::size_t bytes() const;
};

}  // namespace softbody
