#pragma once
// The candidates of surface contact: features of two bodies that may meet in the coming substeps, and what is
// remembered of each from substep to substep.
//
// Which side a feature is on: outside a closed body the normal is simply from the one closest point to the other. A
// vertex is inside if it lies behind the face that it is closest to; it then has only that row. Open surfaces and a
// body and itself have no inside: there the normal is remembered, and points whose normal flips have crossed and are
// brought back. Vertices found inside another body (at the start, or where one was dropped) go out through the faces
// nearest to them; bodies far inside each other, or in one place, are first moved apart as a whole.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collide/surface/closed_shell.h"
#include "collide/surface/surface_search.h"
#include "softbody/mesh/mesh.h"

namespace softbody {

/// What surface contact knows of a body.
struct ContactBody {
  glm::dvec3 origin{0.0};      // m
  std::size_t first_slot = 0;  // of its vertices: first_slot + stride * v
  std::size_t stride = 1;
  float inverse_mass = 0;  // 1/kg, of a particle; 0: it does not move
  float friction = 0, restitution = 0;
  const std::vector<glm::vec3>* rest = nullptr;  // its vertices at rest, m
  std::vector<char> held{};                      // whether each of them is; empty if none is
};

class SurfaceCandidates {
 public:
  /// Two bodies with candidates, or a body and itself.
  struct Pair {
    collide::surface::SurfacePair range;  // of its candidates
    glm::vec3 offset;                     // origin of b minus origin of a
    float distance;                       // m, kept between the surfaces
    float friction, restitution;
    float speed = 0;          // m/s, with which the two may meet
    float rate = 0;           // 1/s: that over how far they may go in a substep
    bool overlap = false;     // some vertex may be inside the other body: see find_interior_vertices()
    bool separating = false;  // so deep, or so much in one place, that the bodies are moved apart as a whole
    std::uint32_t interior = 0, interior_end = 0;  // its interior vertices
    bool closes = false, joins = false;            // see SurfaceContact::find_islands()
    int thread = 0;                                // that makes its rows, and where they are
    std::uint32_t first_row = 0, rows = 0;
    // Since SurfaceContact::take_work():
    double energy = 0, returned = 0;  // J, that pushing the two apart has given, and that restitution will give back
    glm::dvec3 impulse{0.0};          // N s on a
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
    std::span<const char> held;

    bool holds(Index vertex) const { return !held.empty() && held[vertex]; }
  };

  /// Everything that is kept from one substep to the next.
  struct State {
    std::vector<collide::surface::SurfaceBody> traits;
    std::vector<ContactBody> bodies;
    std::vector<collide::surface::SurfaceSearch::History> history;  // one a body
    std::vector<Pair> pairs;                                        // with their ranges in ...
    std::vector<collide::surface::FeaturePair> features;            // ... those of which something is remembered,
    std::vector<CachedContact> cached;                              // namely this

    std::size_t bytes() const;
  };
  State save() const;
  void restore(const State& state);

  /// Finds the candidates of the coming query.seconds. traits and bodies: one a body; slack, and skin beyond the reach,
  /// are set here. Bodies that are likely to stray are foreseen for less, but for the seconds `ahead` at least, and
  /// what is strained fast for query.min_seconds. Throws std::length_error beyond query.max_features; then nothing is
  /// remembered.
  void find(const collide::surface::Motion& motion, std::vector<collide::surface::SurfaceBody> traits,
            std::vector<ContactBody> bodies, const collide::surface::SurfaceQuery& query, float ahead,
            collide::Workers& workers);
  /// Finds the candidates anew, `elapsed` seconds later, of bodies that have strayed from the motion that was foreseen
  /// for them, or whose motion was not foreseen for the seconds `ahead`. Throws as find() does.
  void update(const collide::surface::Motion& motion, float elapsed, float ahead, collide::Workers& workers);
  bool check_valid(const collide::Frame& now, float elapsed, float ahead) {
    return search_.check_valid(now, elapsed, ahead);
  }

  const collide::surface::SurfaceSearch& search() const { return search_; }
  bool empty() const { return pairs_.empty(); }
  std::size_t body_count() const { return bodies_.size(); }
  const std::vector<Pair>& pairs() const { return pairs_; }
  std::vector<Pair>& pairs() { return pairs_; }
  /// Returns the places of the pairs in pairs(), so that those of one colour share no body.
  const std::vector<std::vector<std::uint32_t>>& colours() const { return colours_; }
  CachedContact& cached(std::uint32_t feature) { return cached_[feature]; }
  /// Returns how far (m) the two features of a candidate of the pair are kept from each other at most. Each thread may
  /// ask for pairs of its own.
  float max_gap(const Pair& pair, std::uint32_t feature);
  /// Returns the vertices of a pair that lie inside the other body.
  std::span<const InteriorVertex> interior(const Pair& pair) const {
    return std::span(interior_).subspan(pair.interior, pair.interior_end - pair.interior);
  }
  Side side(const Pair& pair, bool second) const;
  /// Returns the body of the pair and the vertex of it that a slot belongs to.
  std::pair<Index, Index> vertex_at(const Pair& pair, std::uint32_t slot) const;
  /// Returns the pairs of bodies, a < b, of which features may touch in this frame.
  std::vector<collide::surface::ItemPair> interactions() const;
  /// Returns the substeps a second that surface contact needs: the largest relative speed of two bodies with candidates
  /// over the distance that they may pass each other by in a substep.
  float substep_rate() const { return rate_; }

 private:
  using Shells = std::vector<std::optional<collide::surface::ClosedShell>>;  // of the bodies, where one was needed

  template <class Search>
  void search(const collide::Frame& now, const Search& search);
  void take_candidates(const collide::Frame& now);
  void carry_over();
  Pair make_pair(const collide::surface::SurfacePair& range) const;
  void find_interior_vertices(Pair& pair, const collide::Frame& now, Shells& shells);
  void predict_speeds();
  void colour();

  std::vector<collide::surface::SurfaceBody> traits_;
  std::vector<ContactBody> bodies_;
  collide::surface::SurfaceSearch search_;
  std::vector<Pair> pairs_, pairs_before_;             // before: the last find() or update()
  std::vector<CachedContact> cached_, cached_before_;  // of each candidate
  std::vector<float> rest_gap_;                        // m, of each candidate within a body, where it is known
  std::vector<InteriorVertex> interior_;
  std::vector<std::vector<std::uint32_t>> colours_;
  float rate_ = 0;
};

}  // namespace softbody
