#pragma once
// Contact of bodies with solids, on the velocities of a substep: particles of all solids, and faces and edges where
// solids are round or sharp.

#include <span>
#include <utility>
#include <vector>

#include "collide/surface/feature_batch.h"
#include "softbody/contact/contact_row.h"
#include "softbody/contact/kernels.h"
#include "softbody/contact/solid_surface.h"
#include "softbody/state/state.h"

namespace softbody {

/// What solids did to a body in a frame.
struct SolidPush {
  glm::dvec3 impulse{0.0};  // N s, along their normals
  double restitution = 0;   // the largest of those that it came near
  double returned = 0;      // J, that restitution gives back when the body leaves them
};

struct SolidFeature {
  std::array<std::uint32_t, 3> vertices{};
  float free_until = 0;  // m, that its body goes in this frame at least before it can meet the core
};

/// A core of a solid, with the faces or edges of one body that may meet it in the coming frame.
struct NearCore {
  int lane;                 // of the body in its batch
  std::size_t solid;        // among those near the batch
  glm::vec3 from, to, out;  // of the core, from the body's origin
  float distance;           // m, from it to where the body is kept
  float speed;              // m/s, with which the body may come
  std::size_t corners;      // of its features: 3 for a point
  std::vector<SolidFeature> features{};
  float start = 0, end = 0;  // m, that the body may have gone in this frame before and after the substep at hand
};

class SolidContact {
 public:
  /// The state must outlive this.
  explicit SolidContact(State& state) : state_(state) {}

  /// features: faces and edges meet solids, too. restitution: some contact has it.
  void set_parts(bool features, bool restitution) {
    has_features_ = features;
    has_restitution_ = restitution;
  }

  // A frame: begin_frame(), add() for each batch that moves, substeps, end_frame().
  void begin_frame();
  /// Adds those of the solids that a body of the batch may touch within `seconds` (s). extent: of the batch's positions
  /// and velocities now. gravity in m/s^2.
  void add(const Batch& batch, const Extent& extent, std::span<const Solid> solids, const glm::dvec3& gravity,
           double seconds);
  /// Notes the pushes of the frame, and books the energy that they gave.
  void end_frame();

  // A substep.
  /// Notes the velocities that a batch has at the start of a substep, which restitution needs.
  void note_velocities(const Batch& batch);
  /// Returns them; without restitution, the present ones.
  Field<const float> velocities_before() const { return field(has_restitution_ ? before_ : std::as_const(state_.v)); }
  /// Changes the velocities of a batch so that in a step of h seconds no particle enters a solid.
  void apply(const Batch& batch, float h);
  /// True if solids may touch faces or edges of a batch in this frame; see set_parts().
  bool meets_features(const Batch& batch) const {
    return batch.index < of_batch_.size() && !of_batch_[batch.index].cores.empty();
  }
  /// Finds which of these faces and edges may meet a solid in a substep of h (s) from here on. speeds: m/s, that no
  /// particle of a lane exceeds; empty: what was foreseen. Returns a row for each, with slots that count from the
  /// batch's first one; valid until the next call or apply() for this batch.
  std::span<ContactRow> find_feature_rows(const Batch& batch, float h, std::span<const double> speeds = {});
  /// Adds a row for each particle of a body that a solid may stop in this substep if it comes `travel` (m) nearer.
  void add_particle_rows(BodyId body, float travel, std::vector<ContactRow>& rows) const;
  /// Books the impulses of these rows as those of the solids. Threads may call it at once for different bodies.
  void book(BodyId body, std::span<const ContactRow> rows);
  /// Returns where it is summed what the solids do to the bodies of a batch.
  SolidSums sums(const Batch& batch) {
    OfBatch& own = of_batch_[batch.index];
    return {field(own.impulse), own.returned.data(), own.energy.data()};
  }

  /// Returns the solids that the bodies of a batch may touch in this frame.
  std::span<const SolidArguments> near(const Batch& batch) const {
    return batch.index < of_batch_.size() ? std::span<const SolidArguments>(of_batch_[batch.index].near)
                                          : std::span<const SolidArguments>();
  }
  /// Returns the lanes of a batch that solids may have pushed in this frame, as bits.
  unsigned pushed(const Batch& batch) const {
    const OfBatch& own = of_batch_[batch.index];
    unsigned pushed = own.pushed;
    for (std::size_t l = 0; l < lanes; ++l) pushed |= unsigned{own.booked[l]} << l;
    return pushed;
  }

  /// Returns what solids did to a body in the last frame.
  SolidPush push(BodyId body) const { return body < pushes_.size() ? pushes_[body] : SolidPush{}; }
  const std::vector<SolidPush>& pushes() const { return pushes_; }
  void set_pushes(std::vector<SolidPush> pushes) { pushes_ = std::move(pushes); }
  /// Forgets a body that is removed; the ids of later bodies move up.
  void remove(BodyId body);

 private:
  struct OfBatch {
    std::vector<SolidArguments> near;
    std::vector<NearCore> cores;          // that faces or edges of the bodies may meet between their vertices
    std::vector<ContactRow> rows;         // of these, in the substep at hand; each is of a core
    LaneVector impulse{};                 // N s, along the normals
    std::array<float, lanes> returned{};  // J, that restitution gives back
    std::array<float, lanes> energy{};    // J, given by pushing out
    std::array<bool, lanes> booked{};     // no bits: threads write to several at once
    unsigned pushed = 0, eased = 0;       // bits: lanes

    void book(const ContactRow& row, std::size_t lane) {
      softbody::add(field(impulse), lane, row.normal_impulse * row.normal);
      returned[lane] += row.returned;
      energy[lane] += row.energy;
      booked[lane] = true;
    }
  };

  const SolidArguments& add(const Batch& batch, const Solid& solid, unsigned lanes_near);
  bool lies_in(const Batch& batch, int lane, const Solid& solid) const;
  void ease_out(const Batch& batch, int lane, const glm::dvec3& way, const glm::dvec3& gravity, double seconds);
  bool apply_to_particles(const Batch& batch, float h, bool again);
  void find_features(const Batch& batch, const Extent& extent, int lane, const SolidInterior& interior, double travel,
                     double seconds);
  void apply_to_features(const Batch& batch, float h);
  void add_rows(const Batch& batch, NearCore& core, collide::surface::FeatureBatch& meeting, float h);

  State& state_;
  bool has_features_ = false, has_restitution_ = false;
  VectorArray before_;  // velocities at the start of the substep, if there is restitution
  std::vector<OfBatch> of_batch_;
  std::vector<SolidPush> pushes_;  // of each body
};

}  // namespace softbody
