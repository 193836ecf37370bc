#pragma once
// Contact of the true surfaces: vertices against faces and edges against edges, kept a distance apart. Each contact is
// a row (surface_row_maker.h); the rows of a substep are solved by projected Gauss-Seidel with accumulated impulses,
// started from those of the substep before (Catto 2005; many substeps of few iterations, Macklin et al. 2019), of rows
// that push out from a part of them. Bodies' pairs are coloured, so that those of a colour share no body and the result
// does not depend on threads.

#include <functional>
#include <span>
#include <vector>

#include "softbody/contact/contacts.h"
#include "softbody/contact/surface_row_maker.h"

namespace softbody {

class SurfaceContact {
 public:
  /// Everything that is kept from one substep to the next, and the rows that contact_points() returns.
  struct State {
    SurfaceCandidates::State candidates;
    std::vector<ContactRow> rows;  // that pressed
    float last_h = 0;

    std::size_t bytes() const { return candidates.bytes() + rows.size() * sizeof(ContactRow); }
  };
  State save() const;
  void restore(const State& state);

  static constexpr int iterations = 2;      // a substep
  static constexpr int max_iterations = 8;  // see needs_more_iterations()
  static constexpr int max_passes = 8;      // of resolve_after_solids(), which the solids take with it

  /// Takes the threads that will call. To be called before candidates are found.
  void set_threads(int threads) { thread_work_.resize(static_cast<std::size_t>(threads)); }
  SurfaceCandidates& candidates() { return candidates_; }
  const SurfaceCandidates& candidates() const { return candidates_; }

  /// The rows of this substep, from positions at its start, `elapsed` seconds after find(), and velocities with all
  /// forces. On every thread.
  void make_rows(int thread, int threads, Field<const float> x, Field<const float> v, float elapsed, float h);
  /// Solves them on the velocities. On every thread, after a barrier; `barrier` is called by all threads alike.
  void solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
             const std::function<void()>& barrier);
  /// Whether two bodies pass each other half as far as they may in a substep of h, or one lies on itself: what a solid
  /// stops is then hit from behind by the body's other side.
  bool needs_more_iterations(float h) const;
  /// Solves once more the rows of fast pairs whose targets the solids, which act last, have violated. Returns false if
  /// there are none. Call it on every thread, after a barrier.
  bool resolve_after_solids(int thread, int threads, Field<float> v, float h, const std::function<void()>& barrier);

  /// Of the last substep, of h seconds: its candidates, and a half for each time that a contact may have been solved,
  /// or a vertex moved with its whole body.
  double work_of_substep(float h) const;

  std::size_t rows() const;
  /// True if the last substep pushed overlapping surfaces apart or threw colliding ones back, and so added energy.
  bool adds_energy() const;
  /// `vertices`: those of the bodies that find() was given, and perhaps of more. While all bodies sleep it is the last
  /// substep before.
  std::vector<SurfaceContactPoint> contact_points(const collide::Bodies& vertices) const;

 private:
  using Pair = SurfaceCandidates::Pair;
  struct alignas(64) ThreadWork {
    std::vector<ContactRow> rows;
    SurfaceRowMaker::Scratch scratch;
    bool violated = false;  // resolve_after_solids() had something to do
  };

  std::span<const ContactRow> rows_of(const Pair& pair) const {
    return std::span(thread_work_[static_cast<std::size_t>(pair.thread)].rows).subspan(pair.first_row, pair.rows);
  }
  void separate(const Pair& pair, Field<const float> x, Field<float> v) const;
  bool few_rows() const { return rows() < 2000; }
  static bool needs_more_iterations(const Pair& pair, float h) {
    return h * pair.rate > 0.5f || (pair.range.a == pair.range.b && pair.rows > 0);
  }
  bool violates_target(const Pair& pair, Field<const float> v, float h) const;
  template <class Visit>
  void for_each_pair(int thread, int threads, const std::function<void()>& barrier, const Visit& visit);

  SurfaceCandidates candidates_;
  std::vector<ThreadWork> thread_work_;
  float last_h_ = 0;  // s, of the last substep
};

}  // namespace softbody
