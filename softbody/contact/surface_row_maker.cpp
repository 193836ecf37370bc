#include "softbody/contact/surface_row_maker.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

using collide::surface::Closest;
using collide::surface::FeatureBatch;
using collide::surface::FeaturePair;
using collide::surface::PairKind;

constexpr float hair = 0.02f;      // of the distance, that may be used up unsolved
constexpr float push_kept = 0.8f;  // of an impulse that pushes out is handed on to the next substep; by trial

void set_corner(ContactRow& row, std::size_t k, const SurfaceCandidates::Side& side, Index vertex, float weight) {
  row.slot[k] = std::uint32_t(side.slot + vertex * side.stride);
  row.weight[k] = weight;
  row.mobility[k] = side.inverse_mass > 0 && side.holds(vertex) ? held_mobility : side.inverse_mass * weight;
}

/// Returns a row of which only the corners are set.
template <PairKind kind>
ContactRow row_between(const SurfaceCandidates::Side& one, Index feature_one, const SurfaceCandidates::Side& two,
                       Index feature_two, const Closest& c, std::uint32_t candidate) {
  ContactRow row{};
  const std::array<Index, 4> vertex =
      collide::surface::corners_of<kind>(*one.surface, feature_one, *two.surface, feature_two);
  for (std::size_t k = 0; k < 4; ++k) {
    const bool first = k < collide::surface::corners_of_first(kind);
    set_corner(row, k, first ? one : two, vertex[k], first ? c.weight[k] : -c.weight[k]);
  }
  row.feature = candidate;
  return row;
}

/// Turns the normal to the side that is remembered. Returns true if the features are on the other side now.
bool orient(SurfaceCandidates::CachedContact& cached, bool inner, glm::vec3& normal) {
  const bool crossed = inner && glm::dot(cached.normal, normal) < 0;
  if (crossed) normal = -normal;
  cached.normal = inner ? normal : glm::vec3(0.0f);
  return crossed;
}

}  // namespace

void SurfaceRowMaker::add_rows(Pair& p) {
  p.first_row = std::uint32_t(rows_.size());
  p.rows = 0;
  if (p.separating) return;
  const bool interior = p.interior < p.interior_end;
  if (interior) add_interior_vertices(p);
  vertices_on_faces(p, p.range.vertex_face, p.range.face_vertex, false);
  vertices_on_faces(p, p.range.face_vertex, p.range.edge_edge, true);
  if (!interior) edges_on_edges(p);
  p.rows = std::uint32_t(rows_.size()) - p.first_row;
}

/// Finds the closest points of those candidates that may meet in this substep. Calls visit(batch, i) for each.
template <PairKind kind, class Visit>
void SurfaceRowMaker::meet(const Side& one, const Side& two, std::uint32_t begin, std::uint32_t end,
                           const Visit& visit) {
  const Side& second = collide::surface::corners_of_first(kind) == 2 ? one : two;  // of the four corners
  FeatureBatch& meeting = scratch_.meeting;
  for (std::uint32_t i = begin; i < end;) {
    meeting.clear();
    for (; i < end && !meeting.full(); ++i) {
      const FeaturePair& f = candidates_.search().features()[i];
      if (f.earliest > step_.until) continue;
      const auto [p, q, r, s] = collide::surface::corners_of<kind>(*one.surface, f.a, *two.surface, f.b);
      meeting.add({at(one, p), at(second, q), at(two, r), at(two, s)}, i);
    }
    meeting.find_closest<kind>();
    for (Index k = 0; k < meeting.size(); ++k) visit(meeting, k);
  }
}

void SurfaceRowMaker::vertices_on_faces(Pair& pair, std::uint32_t begin, std::uint32_t end, bool vertex_of_b) {
  const Side vertex_side = candidates_.side(pair, vertex_of_b), face_side = candidates_.side(pair, !vertex_of_b);
  const Side faces = pair.range.a == pair.range.b ? vertex_side : face_side;
  const bool oriented = pair.range.a == pair.range.b || !faces.surface->closed();
  const auto is_interior = [&](Index v) {
    return std::ranges::any_of(candidates_.interior(pair), [&](const SurfaceCandidates::InteriorVertex& d) {
      return d.vertex == v && d.of_b == vertex_of_b;
    });
  };
  const auto& features = candidates_.search().features();
  const float max_distance2 = max_distance(pair) * max_distance(pair);
  scratch_.near_faces.clear();
  const auto flush = [&] {
    if (!scratch_.near_faces.empty() && !is_interior(features[scratch_.near_faces[0].feature].a))
      vertex_on_faces(pair, vertex_side, faces, oriented);
    scratch_.near_faces.clear();
  };
  meet<PairKind::vertex_face>(vertex_side, faces, begin, end, [&](const FeatureBatch& meeting, Index k) {
    const std::uint32_t feature = meeting.tag(k);
    if (!scratch_.near_faces.empty() && features[scratch_.near_faces[0].feature].a != features[feature].a) flush();
    if (meeting.distance2(k) > max_distance2)
      candidates_.cached(feature) = {};
    else
      scratch_.near_faces.push_back({meeting.closest_vertex_face(k),
                                     normal_of(meeting.corner(1, k), meeting.corner(2, k), meeting.corner(3, k)),
                                     meeting.distance2(k), feature});
  });
  flush();
}

/// Adds the rows of one vertex, whose near faces are listed.
void SurfaceRowMaker::vertex_on_faces(Pair& pair, const Side& vertex_side, const Side& face_side, bool oriented) {
  const auto& features = candidates_.search().features();
  const std::vector<NearFace>& near_faces = scratch_.near_faces;
  const auto corners = [&](const NearFace& n) {
    const FeaturePair& f = features[n.feature];
    return row_between<PairKind::vertex_face>(vertex_side, f.a, face_side, f.b, n.closest, n.feature);
  };
  if (!oriented) {
    const auto facing =
        [](const NearFace& n) {  // cosine, its sign dropped, between the normal and the way to the vertex
          return std::abs(glm::dot(n.closest.separation, n.face_normal)) / glm::length(n.face_normal);
        };
    const NearFace* nearest = &near_faces[0];
    for (const NearFace& n : near_faces) {
      // Faces that share the closest point: the one that faces the vertex most tells which side it is on.
      const bool tie = std::abs(n.distance2 - nearest->distance2) <= 1e-5f * nearest->distance2;
      if (tie ? facing(n) > facing(*nearest) : n.distance2 < nearest->distance2) nearest = &n;
    }
    if (glm::dot(nearest->closest.separation, nearest->face_normal) < 0) {
      const float depth = std::sqrt(nearest->distance2);
      for (const NearFace& n : near_faces)
        candidates_.cached(n.feature).normal_impulse =
            n.feature == nearest->feature ? candidates_.cached(n.feature).normal_impulse : 0;
      if (depth > pair.distance) pair.overlap = true;  // to be looked at when candidates are found next
      add_row(pair, corners(*nearest), unit(-nearest->closest.separation, nearest->face_normal), -depth,
              candidates_.cached(nearest->feature));
      return;
    }
  }
  for (std::size_t k = 0; k < near_faces.size(); ++k) {
    const NearFace& n = near_faces[k];
    CachedContact& cached = candidates_.cached(n.feature);
    const bool needless = stays_apart(pair, n.feature, std::sqrt(n.distance2));
    if (needless && !oriented) continue;
    const bool twice = !n.closest.inner &&
                       std::any_of(near_faces.begin(), near_faces.begin() + std::ptrdiff_t(k), [&](const NearFace& m) {
                         const glm::vec3 d = m.closest.separation - n.closest.separation;
                         return glm::dot(d, d) <= 1e-6f * n.distance2;
                       });
    if (twice) {
      cached = {};
      continue;
    }
    glm::vec3 normal = unit(n.closest.separation, oriented ? cached.normal : n.face_normal);
    const bool crossed = oriented && orient(cached, n.closest.inner, normal);
    if (needless && !crossed) continue;
    add_row(pair, corners(n), normal, std::sqrt(n.distance2) * (crossed ? -1.0f : 1.0f), cached);
  }
}

/// Adds the rows of vertices deep inside another body: each leaves by the plane of the face that it is closest to.
void SurfaceRowMaker::add_interior_vertices(Pair& pair) {
  for (const SurfaceCandidates::InteriorVertex& d : candidates_.interior(pair)) {
    const Side vertex_side = candidates_.side(pair, d.of_b), face_side = candidates_.side(pair, !d.of_b);
    const collide::surface::Triangle& face = face_side.surface->triangles()[d.face];
    glm::vec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = at(face_side, face[k]);
    const glm::vec3 p = at(vertex_side, d.vertex);
    const Closest c = collide::surface::closest_vertex_face(p, corner[0], corner[1], corner[2]);
    const glm::vec3 normal = unit(normal_of(corner[0], corner[1], corner[2]), {});
    const ContactRow row = row_between<PairKind::vertex_face>(vertex_side, d.vertex, face_side, d.face, c, uncached);
    CachedContact unseen;
    add_row(pair, row, normal, glm::dot(p - corner[0], normal), unseen);
  }
}

void SurfaceRowMaker::edges_on_edges(Pair& pair) {
  const collide::surface::SurfacePair& range = pair.range;
  const auto& features = candidates_.search().features();
  const bool self = range.a == range.b;
  const Side one = candidates_.side(pair, false), two = self ? one : candidates_.side(pair, true);
  const bool closed = !self && one.surface->closed() && two.surface->closed();
  const float max_distance2 = max_distance(pair) * max_distance(pair);
  const auto outward = [&](const Side& s, Index edge) {
    glm::vec3 sum(0.0f);
    for (const Index f : s.surface->edge_triangles()[edge]) {
      const collide::surface::Triangle& face = s.surface->triangles()[f];
      sum += unit(normal_of(at(s, face[0]), at(s, face[1]), at(s, face[2])), {});
    }
    return sum;
  };
  const auto meets = [&](std::uint32_t i, const Closest& c, float distance2) {
    const FeaturePair& f = features[i];
    CachedContact& cached = candidates_.cached(i);
    const float distance = std::sqrt(distance2);
    const bool needless = stays_apart(pair, i, distance);
    glm::vec3 normal = unit(c.separation, cached.normal);
    bool crossed = false;
    if (!closed) {
      crossed = orient(cached, true, normal);
    } else if (glm::dot(cached.normal, normal) <= 0.5f) {  // else they are on the sides that they were on before
      const float out_of_two = glm::dot(normal, outward(two, f.b)), out_of_one = glm::dot(normal, outward(one, f.a));
      crossed = out_of_two < out_of_one;
      // The one sees the other from within it, as a sphere pressed deep into a ball sees the ball's far side: what lies
      // between them keeps them apart. Or it is the far side of something thin.
      if (out_of_one * out_of_two > 0 || (crossed && distance > pair.distance)) {
        cached = {};
        return;
      }
      cached.normal = crossed ? glm::vec3(0.0f) : normal;
      if (crossed) normal = -normal;
    }
    if (needless && !crossed) return;
    add_row(pair, row_between<PairKind::edge_edge>(one, f.a, two, f.b, c, i), normal, crossed ? -distance : distance,
            cached);
  };
  meet<PairKind::edge_edge>(one, two, range.edge_edge, range.end, [&](const FeatureBatch& meeting, Index k) {
    if (meeting.inner(k) && meeting.distance2(k) <= max_distance2)
      meets(meeting.tag(k), meeting.closest_edges(k), meeting.distance2(k));
    else  // those that end on a corner are a vertex's
      candidates_.cached(meeting.tag(k)) = {};
  });
}

/// Returns true if a candidate needs no row: nothing that is as fast as was foreseen uses half of the distance up.
bool SurfaceRowMaker::stays_apart(const Pair& pair, std::uint32_t feature, float apart) {
  const float distance = candidates_.max_gap(pair, feature);
  return apart > std::max(distance, 0.5f * distance + step_.h * pair.speed) &&
         candidates_.cached(feature).normal_impulse == 0;
}

/// Adds a row, unless nothing can move either side. apart: between the surfaces, negative where they overlap.
void SurfaceRowMaker::add_row(const Pair& pair, const ContactRow& corners, const glm::vec3& normal, float apart,
                              CachedContact& cached) {
  float mobility = 0;
  for (std::size_t k = 0; k < 4; ++k) mobility += corners.weight[k] * corners.mobility[k];
  if (mobility <= least_mobility) return;
  const float distance = corners.feature == uncached ? pair.distance : candidates_.max_gap(pair, corners.feature);
  const float gap = apart - distance;
  ContactRow& row = rows_.emplace_back(corners);
  row.normal = normal;
  row.mass = 1 / mobility;
  // A spring and damper hold the distance; half of it is never given up, and what overlaps is pushed out.
  const float spare = apart - 0.5f * distance;
  row.target = law::min_move(spare, step_.h) / step_.h;
  const float turn = step_.h * std::min(spring_frequency, 0.25f * 2 * glm::pi<float>() / step_.h);
  row.relative_stiffness = gap < 0 ? turn * (2 * spring_damping + turn) : 0;
  row.bias = -gap * turn / ((2 * spring_damping + turn) * step_.h);
  row.push = std::max({0.0f, row.target, gap < 0 ? row.bias : 0.0f});
  row.restitution = pair.restitution;
  row.before = row.restitution > 0 ? glm::dot(relative_velocity(row, step_.before), normal) : 0;
  row.slack = hair * pair.distance / step_.h;
  row.friction = pair.friction;
  // Bodies that stand in each other's way cannot all be pushed out as they ask for: handed on in full, their impulses
  // would grow with every substep.
  const float kept = spare > 0 ? step_.h_ratio : push_kept * step_.h_ratio;
  row.normal_impulse = kept * cached.normal_impulse;
  row.friction_impulse = kept * (cached.friction_impulse - glm::dot(cached.friction_impulse, normal) * normal);
}

}  // namespace softbody
