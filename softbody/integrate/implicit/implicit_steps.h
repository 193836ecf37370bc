#pragma once
// Implicit steps of batches of bodies.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "softbody/contact/contact_row.h"
#include "softbody/contact/solid_law.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/implicit/matrix.h"
#include "softbody/integrate/implicit/quasi_newton.h"

namespace softbody {

/// The start of a step of a batch, and what may touch it.
struct ImplicitBatch {
  const Batch& batch;
  Field<const float> x, v;  // m and m/s, of all batches
  glm::dvec3 gravity;       // m/s^2
  std::span<const SolidArguments> near_solids;
  std::span<const ContactRow> features;   // of the bodies, which may meet these solids between vertices
  PenaltyContact& penalty;                // evaluated at x, v; is told what its pairs do
  std::span<const PenaltyEnd> ends;       // of its pairs, those that fall to this batch
  std::function<bool(BodyId)> is_moving;  // false for bodies that are held or asleep
  std::size_t first_lane = 0;             // of the batch, of implicit_lanes that are solved side by side
  std::span<const HeldParticle> held{};   // of the batch

  /// Returns where the value `at` = particle * implicit_lanes + lane stands in the fields of all batches.
  std::size_t slot(std::size_t at) const {
    return batch.base + at / implicit_lanes * std::size_t(batch.width) + first_lane + at % implicit_lanes;
  }
  /// Returns where the value of a slot stands in a field of the step; nothing if it is in none of its lanes.
  std::optional<std::size_t> place(std::size_t slot) const {
    const std::size_t in_batch = slot - batch.base, lane = in_batch % std::size_t(batch.width) - first_lane;
    if (lane >= implicit_lanes) return std::nullopt;
    return in_batch / std::size_t(batch.width) * implicit_lanes + lane;
  }
};

/// Where the end of a step goes. Lanes that do not move are left alone.
struct ImplicitResult {
  Field<float> mean, rest;  // m/s, of all batches: velocities that lead to the end, and what they change by there
  SolidSums solids;
};

/// Keeps up to eight matrices of one body model, by step length. Two of them are in use at a time.
class ImplicitMatrices {
 public:
  static constexpr std::size_t max_lengths = 8;

  /// Makes the matrix for steps of h (s), unless it is there. For a ninth step length the one that has not been
  /// prepared for longest is forgotten. Throws SceneError as ImplicitMatrix does.
  void prepare(const BodyModel& model, double h);
  /// Returns the matrix for steps of h, which must be prepared.
  const ImplicitMatrix& at(double h) const;

 private:
  struct Entry {
    double h;
    std::unique_ptr<const ImplicitMatrix> matrix;
  };
  std::vector<Entry> entries_;  // in the order in which they were prepared last
};

/// Takes the steps, and owns the matrices and the workspaces that they need.
class ImplicitSteps {
 public:
  /// Forgets the body models that are not in use.
  void retain(const std::function<bool(const BodyModel&)>& in_use);
  /// Gets ready for steps of h (s) of the model's bodies on threads 0 to threads - 1. Throws SceneError as
  /// ImplicitMatrix does.
  void prepare(const std::shared_ptr<const BodyModel>& model, double h, int threads);
  /// Takes a step of h, which must be prepared, of all lanes of a batch. Threads may take steps of different batches at
  /// the same time.
  void advance(int thread, ImplicitBatch batch, const ImplicitResult& result, double h);
  /// Returns the work of all threads since the last call, see QuasiNewton::take_work().
  double take_work();

 private:
  /// What a thread computes with while it takes steps of one body model.
  struct Work {
    explicit Work(const BodyModel& model) : solver(model), bodies(model) {}
    QuasiNewton solver;
    ImplicitBodies bodies;
    ImplicitStart start;
  };
  struct OfModel {
    ImplicitMatrices matrices;
    std::vector<Work> work;  // of each thread
  };
  static void advance_part(OfModel& own, int thread, const ImplicitBatch& part, const ImplicitResult& result, double h);

  std::map<std::shared_ptr<const BodyModel>, OfModel> models_;
};

}  // namespace softbody
