#pragma once
// Contact of the true surfaces: vertices against faces and edges against edges, kept a distance apart. Each contact is
// a row (surface_row_maker.h); the rows of a substep are solved by projected Gauss-Seidel with accumulated impulses,
// started from those of the substep before (Catto 2005; many substeps of few iterations, Macklin et al. 2019), of rows
// that push out from a part of them. Bodies' pairs are coloured, so that those of a colour share no body and the result
// does not depend on threads. What still closes too fast once solids have acted is solved together with these, island
// by island (joint_solve.h).

#include <functional>
#include <span>
#include <vector>

#include "softbody/contact/contacts.h"
#include "softbody/contact/joint_solve.h"
#include "softbody/contact/rebound.h"
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

  static constexpr int iterations = 2;  // a substep

  /// Pairs that are solved together with the solids that their bodies touch.
  struct Island {
    std::vector<std::uint32_t> pairs;  // their places
    std::vector<Index> bodies;
    float speed = 0;      // m/s, with which they may meet
    bool closes = false;  // a contact closes too fast
  };

  /// Takes the threads that will call. To be called before candidates are found.
  void set_threads(int threads) { of_thread_.resize(std::size_t(threads)); }
  SurfaceCandidates& candidates() { return candidates_; }
  const SurfaceCandidates& candidates() const { return candidates_; }

  /// Makes the rows of this substep, from positions at its start, `elapsed` seconds after find(). On every thread.
  /// before: the velocities without the forces of this substep.
  void make_rows(int thread, int threads, Field<const float> x, Field<const float> before, float elapsed, float h);
  /// Solves them on the velocities. On every thread, after a barrier; `barrier` is called by all threads alike.
  void solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
             const std::function<void()>& barrier);
  /// Finds the contacts that close too fast now that solids, which act after solve(), have pushed bodies back. Returns
  /// false if there are none. On every thread, after a barrier; all must be in islands() before the next barrier.
  bool find_islands(int thread, int threads, Field<const float> v, const std::function<void()>& barrier);
  const std::vector<Island>& islands() const { return islands_; }
  /// Solves the rows of an island together with those of solids. Each island on one thread; they share no body.
  void solve_island(int thread, const Island& island, std::span<ContactRow> solids, Field<float> v);

  /// Returns the work of the last substep: its candidates, and a half for each time that a contact was solved or a
  /// vertex moved with its whole body.
  double work_of_substep() const;

  std::size_t rows() const;
  /// Returns true if some row pressed in the last substep. A snapshot keeps such rows only.
  bool presses() const;
  /// Adds up what the rows of a substep do, which all threads must have solved. On every thread.
  void add_row_work(int thread, int threads, Field<const float> v);
  /// Returns the energy (J) that pushing apart has given to bodies since the last call. Adds the impulses of pairs that
  /// have restitution to `rebounds`.
  double take_work(Rebounds& rebounds);
  /// `vertices`: those of the bodies that find() was given, and perhaps of more. While all bodies sleep it is the last
  /// substep before.
  std::vector<SurfaceContactPoint> contact_points(const collide::Bodies& vertices) const;

 private:
  using Pair = SurfaceCandidates::Pair;
  struct alignas(64) OfThread {
    std::vector<ContactRow> rows;
    SurfaceRowMaker::Scratch scratch;
    JointSolver joint;
    std::vector<ContactRow*> together;
    double joint_work = 0;  // of the last substep: rows, each as often as it was solved
  };

  std::span<const ContactRow> rows_of(const Pair& pair) const {
    return std::span(of_thread_[std::size_t(pair.thread)].rows).subspan(pair.first_row, pair.rows);
  }
  std::span<ContactRow> rows_of(const Pair& pair) {
    return std::span(of_thread_[std::size_t(pair.thread)].rows).subspan(pair.first_row, pair.rows);
  }
  void keep(const ContactRow& row);
  void join_islands();
  void separate(Pair& pair, Field<const float> x, Field<float> v) const;

  SurfaceCandidates candidates_;
  std::vector<OfThread> of_thread_;
  std::vector<Island> islands_;
  float last_h_ = 0;  // s, of the last substep
};

}  // namespace softbody
