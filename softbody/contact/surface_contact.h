#pragma once
// Contact of the true surfaces: vertices against faces and edges against edges, kept a distance apart.
//
// A contact is a row: the relative velocity u of the two closest points, along the unit normal n, must not use up the
// gap g within the substep of h seconds,
//
//   u . n >= -(g + d/2) / h    while half of the distance d is left: nothing passes through;
//   u . n >= 0.1 (-g - d/2) / h  where it is not: pushed out at a bounded speed;
//   u . n >= e |u_before . n|  at an impact: Newton's restitution.
//
// The share of 0.1, both speeds and the cone of friction are those of contact/law.h.
// Impulses that bring this about act on the corners by their weights, equal and opposite along the line between the two
// points, so that linear and angular momentum stay (but for friction, which is a couple over the distance kept). The
// distance itself is held by a spring with a damper, integrated implicitly as in a soft constraint (Catto 2011): what
// rests neither sinks in nor trembles; friction takes at most mu times them from the slip (Coulomb). The rows of a
// substep are solved by projected Gauss-Seidel with accumulated impulses, started from those of the substep before
// (Catto 2005; many substeps of few iterations, Macklin et al. 2019), of rows that push out from a part of them.
// Bodies' pairs are coloured, so that those of a colour share no body and the result does not depend on threads.
//
// Which side a feature is on: outside a closed body the normal is simply from the one closest point to the other. A
// vertex is inside if it lies behind the face that it is closest to; it then has only that row. Open surfaces and a
// body and itself have no inside: there the normal is remembered, and points whose normal flips have crossed and are
// brought back. Vertices found inside another body (at the start, or where one was dropped) go out through the faces
// nearest to them; bodies far inside each other, or in one place, are first moved apart as a whole.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "collide/surface/closed_shell.h"
#include "collide/surface/surface_search.h"
#include "softbody/contact/contacts.h"
#include "softbody/state/lanes.h"

namespace softbody {

/// What surface contact knows of a body.
struct ContactBody {
  glm::dvec3 origin{0.0};      // m
  std::size_t first_slot = 0;  // of its vertices: first_slot + stride * v
  std::size_t stride = 1;
  float inverse_mass = 0;  // 1/kg, of a particle; 0: it does not move
  float friction = 0, restitution = 0;
  const std::vector<glm::vec3>* rest = nullptr;  // its vertices at rest, m
};

struct ContactRow {
  std::array<std::uint32_t, 4> slot;
  std::array<float, 4> weight;    // first side positive, second negative
  std::array<float, 4> mobility;  // weight / mass
  glm::vec3 normal;               // unit, from the second side to the first
  float mass;                     // kg, effective: 1 / sum of weight^2 / mass
  float relative_stiffness;  // of the spring that keeps the distance, times the substep squared, over the mass; 0: out
                             // of its reach
  float bias;                // m/s, that it asks for
  float target;              // m/s, least normal speed
  float push;                // m/s, at most so fast it pushes apart
  float friction;
  float normal_impulse;        // N s, accumulated along the normal
  glm::vec3 friction_impulse;  // N s, accumulated across it
  std::uint32_t feature;       // place in the search's features
};

class SurfaceContact {
 public:
  /// Everything that is kept from one substep to the next, and the rows that contact_points() returns.
  struct State;
  State save() const;
  void restore(const State& state);

  static constexpr int iterations = 2;      // a substep
  static constexpr int max_iterations = 8;  // see needs_more_iterations()
  static constexpr int max_passes = 8;      // of resolve_after_solids(), which the solids take with it
  // Of the spring that keeps the distance, against the effective mass of the contact:
  static constexpr float spring_frequency = 750;  // 1/s, angular
  static constexpr float spring_damping = 5;      // of the critical

  /// The candidates of the coming `seconds`. traits and bodies: one a body; slack, and skin beyond the reach, are set
  /// here. Bodies that are likely to stray are foreseen for less, but for the seconds `ahead` at least, and what is
  /// strained fast for query.min_seconds. Throws std::length_error beyond query.max_features; then nothing is
  /// remembered.
  void find(const collide::surface::Motion& motion, std::vector<collide::surface::SurfaceBody> traits,
            std::vector<ContactBody> bodies, const collide::surface::SurfaceQuery& query, float ahead,
            collide::Workers& workers);
  /// `elapsed` seconds later: those of bodies that have strayed from the motion that was foreseen, or whose was not
  /// foreseen for the seconds `ahead`, anew. Throws as find() does.
  void update(const collide::surface::Motion& motion, float elapsed, float ahead, collide::Workers& workers);
  void clear();
  bool check_valid(const collide::Frame& now, float elapsed, float ahead) {
    return search_.check_valid(now, elapsed, ahead);
  }
  const collide::surface::SurfaceSearch& search() const { return search_; }
  bool empty() const { return pairs_.empty(); }
  /// Returns the substeps a second that surface contact needs: the largest relative speed of two bodies with candidates
  /// over the distance that they may pass each other by in a substep.
  float substep_rate() const { return rate_; }

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

  /// Returns the pairs of bodies, a < b, of which features may touch in this frame.
  std::vector<collide::surface::ItemPair> interactions() const;
  std::size_t rows() const;
  /// Returns the energy (J) that pushing apart has given to bodies since the last call.
  double take_work();
  /// `vertices`: those of the bodies that find() was given, and perhaps of more. While all bodies sleep it is the last
  /// substep before.
  std::vector<SurfaceContactPoint> contact_points(const collide::Bodies& vertices) const;

 private:
  struct Pair {
    collide::surface::SurfacePair range;
    glm::vec3 offset;  // origin of b minus origin of a
    float distance;    // m, kept between the surfaces
    float friction, restitution;
    float inverse_a, inverse_b;
    std::size_t slot_a, slot_b;
    float speed = 0;          // m/s, with which the two may meet
    float rate = 0;           // 1/s: that over how far they may go in a substep
    bool overlap = false;     // some vertex may be inside the other body: see find_interior_vertices()
    bool separating = false;  // so deep, or so much in one place, that the bodies are moved apart as a whole
    std::uint32_t interior = 0, interior_end = 0;
    int thread = 0;
    std::uint32_t first_row = 0, rows = 0;
    double work = 0;  // J, see take_work()
  };
  /// What is remembered of a candidate.
  struct CachedContact {
    glm::vec3 normal{0.0f};
    float normal_impulse = 0;
    glm::vec3 friction_impulse{0.0f};
  };
  struct InteriorVertex {
    Index vertex, face;
    bool of_b;  // whose vertex it is
  };
  /// One body of a pair, seen from the other's origin where that is the first.
  struct Side {
    const collide::surface::Surface* surface;
    std::size_t slot, stride;  // as of ContactBody
    glm::vec3 offset;
    float inverse_mass;
  };
  struct NearFace {
    collide::surface::Closest closest;
    glm::vec3 face_normal;  // not of unit length
    float distance2;
    std::uint32_t feature;
  };
  struct alignas(64) ThreadWork {
    std::vector<ContactRow> rows;
    std::vector<NearFace> near_faces;  // faces near one vertex
    collide::surface::FeatureBatch meeting;
    bool violated = false;  // resolve_after_solids() had something to do
  };
  /// The state of a substep, as one thread sees it.
  struct Step {
    Field<const float> x, v;
    float h;
    float until;  // s after the candidates were found: the end of the substep
    ThreadWork& work;
    Pair& pair;
    float max_distance;  // m: no contact beyond it
    float h_ratio;       // the length of this substep over that of the last one; 0: there was none
  };

  using Shells = std::vector<std::optional<collide::surface::ClosedShell>>;  // of the bodies, where one was needed

  template <class Search>
  void search(const collide::Frame& now, const Search& search);
  void take_candidates(const collide::Frame& now);
  void carry_over();
  Pair make_pair(const collide::surface::SurfacePair& range) const;
  void find_interior_vertices(Pair& pair, const collide::Frame& now, Shells& shells);
  void limit_gaps_at_rest(const Pair& pair);
  void predict_speeds();
  void colour();
  Side side(const Pair& pair, bool second) const;
  Index owner(const Pair& pair, std::uint32_t slot) const;
  /// Where a vertex is at the start of the substep.
  static glm::vec3 at(const Step& step, const Side& side, Index vertex);
  void vertices_on_faces(Step& step, std::uint32_t begin, std::uint32_t end, bool vertex_of_b);
  void vertex_on_faces(Step& step, const Side& vertex_side, const Side& face_side, bool oriented);
  void add_interior_vertices(Step& step);
  void edges_on_edges(Step& step);
  void separate(Pair& pair, Field<const float> x, Field<float> v) const;
  bool orient(CachedContact& cached, bool inner, glm::vec3& normal) const;
  bool few_rows() const { return rows() < 2000; }
  static bool needs_more_iterations(const Pair& pair, float h) {
    return h * pair.rate > 0.5f || (pair.range.a == pair.range.b && pair.rows > 0);
  }
  bool violates_target(const Pair& pair, Field<const float> v, float h) const;
  template <class Visit>
  void for_each_pair(int thread, int threads, const std::function<void()>& barrier, const Visit& visit);
  void add_row(Step& step, const ContactRow& corners, const glm::vec3& normal, float apart, CachedContact& cached);

  std::vector<collide::surface::SurfaceBody> traits_;
  std::vector<ContactBody> bodies_;
  collide::surface::SurfaceSearch search_;
  std::vector<Pair> pairs_, pairs_before_;             // before: the last find() or update()
  std::vector<CachedContact> cached_, cached_before_;  // of each feature pair
  std::vector<float> max_gap_;  // m, of each feature pair: no more than this is kept between the two
  std::vector<InteriorVertex> interior_;
  std::vector<std::vector<std::uint32_t>> colours_;
  std::vector<ThreadWork> thread_work_;
  float rate_ = 0;
  float last_h_ = 0;  // s, of the last substep
};

struct SurfaceContact::State {
  std::vector<collide::surface::SurfaceBody> traits;
  std::vector<ContactBody> bodies;
  std::vector<collide::surface::SurfaceSearch::History> history;  // one a body
  std::vector<Pair> pairs;                                        // with their ranges in ...
  std::vector<collide::surface::FeaturePair> features;            // ... those of which something is remembered,
  std::vector<CachedContact> cached;                              // namely this,
  std::vector<ContactRow> rows;                                   // and in those that pressed
  float last_h = 0;

  std::size_t bytes() const;
};

}  // namespace softbody
