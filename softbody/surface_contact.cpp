#include "softbody/surface_contact.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace softbody {
namespace {

using collide::Closest;
using collide::FeaturePair;
using collide::Surface;

constexpr float push_share = 0.1f;   // of an overlap, a substep
constexpr float step_share = 0.15f;  // of the shorter mean edge: how far two bodies may pass each other in a substep
constexpr float deep_share = 0.25f;  // of the shorter mean edge: deeper bodies are parted as a whole
constexpr std::uint32_t forgotten = std::numeric_limits<std::uint32_t>::max();

glm::vec3 read(Field<const float> f, std::size_t slot) { return {f.x[slot], f.y[slot], f.z[slot]}; }

void add(Field<float> f, std::size_t slot, const glm::vec3& d) {
  f.x[slot] += d.x;
  f.y[slot] += d.y;
  f.z[slot] += d.z;
}

glm::vec3 normal_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) { return glm::cross(b - a, c - a); }

/// Of the two closest points. Bodies that do not move stand, whatever velocity they will set out with.
glm::vec3 relative_velocity(const ContactRow& row, Field<const float> v) {
  glm::vec3 velocity(0.0f);
  for (std::size_t k = 0; k < 4; ++k)
    if (row.mobility[k] != 0) velocity += row.weight[k] * read(v, row.slot[k]);
  return velocity;
}

/// v, or `otherwise` if it has no length to speak of; of unit length.
glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
  const float length = glm::length(v);
  if (length > 1e-9f) return v / length;
  const float other = glm::length(otherwise);
  return other > 0 ? otherwise / other : glm::vec3(0, 1, 0);
}

}  // namespace

void SurfaceContact::clear() {
  last_h_ = 0;
  search_.clear();
  bodies_.clear();
  pairs_.clear();
  memory_.clear();
  deep_.clear();
  colours_.clear();
  rate_ = 0;
}

void SurfaceContact::find(const collide::Motion& motion, std::vector<collide::SurfaceBody> traits,
                          std::vector<ContactBody> bodies, float seconds, bool self, collide::Workers& workers) {
  const std::vector<FeaturePair> old_features = search_.features();
  const std::vector<Pair> old_pairs = std::move(pairs_);
  const std::vector<Memory> old_memory = std::move(memory_);
  traits_ = std::move(traits);
  bodies_ = std::move(bodies);
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  search_.find(motion, traits_, seconds, self, workers);
  pairs_.clear();
  for (const collide::SurfacePair& range : search_.pairs()) pairs_.push_back(make_pair(range));
  memory_.assign(search_.features().size(), {});
  room_.assign(search_.features().size(), std::numeric_limits<float>::max());
  inherit(old_pairs, old_features, old_memory);
  for (const Pair& p : pairs_)
    if (p.range.a == p.range.b) leave_room(p);
  deep_.clear();
  for (Pair& p : pairs_)
    if (p.overlap) find_deep(p);
  foresee_speeds();
  colour();
}

/// Within a body, what is closer at rest than the distance that surfaces keep is not pushed apart.
void SurfaceContact::leave_room(const Pair& pair) {
  constexpr float share = 0.9f;
  const Surface& surface = *traits_[pair.range.a].surface;
  const std::vector<glm::vec3>& rest = *bodies_[pair.range.a].rest;
  const auto room = [&](const Closest& c) { return std::min(pair.distance, share * glm::length(c.apart)); };
  for (std::uint32_t i = pair.range.vertex_face; i < pair.range.end; ++i) {
    const FeaturePair& f = search_.features()[i];
    if (i < pair.range.edge_edge) {
      const auto& [a, b, c] = surface.triangles()[f.b];
      room_[i] = room(collide::closest_vertex_face(rest[f.a], rest[a], rest[b], rest[c]));
    } else {
      const collide::Edge &one = surface.edges()[f.a], &two = surface.edges()[f.b];
      room_[i] = room(collide::closest_edges(rest[one[0]], rest[one[1]], rest[two[0]], rest[two[1]]));
    }
  }
}

/// A pair may be hit through its neighbours within one substep: it is looked at as far as either body's fastest pair
/// goes.
void SurfaceContact::foresee_speeds() {
  std::vector<float> fastest(bodies_.size(), 0);
  rate_ = 0;
  for (const Pair& p : pairs_) {
    const float speed = search_.speed(p.range), edge = std::min(traits_[p.range.a].edge, traits_[p.range.b].edge);
    for (const Index body : {p.range.a, p.range.b}) fastest[body] = std::max(fastest[body], speed);
    rate_ = std::max(rate_, speed / (step_share * edge));
  }
  for (Pair& p : pairs_) p.speed = std::max(fastest[p.range.a], fastest[p.range.b]);
}

SurfaceContact::Pair SurfaceContact::make_pair(const collide::SurfacePair& range) const {
  const ContactBody &a = bodies_[range.a], &b = bodies_[range.b];
  const auto reach = [&](Index body) { return traits_[body].skin - traits_[body].slack; };
  return {.range = range,
          .offset = glm::vec3(b.origin - a.origin),
          .distance = reach(range.a) + reach(range.b),
          .friction = std::sqrt(a.friction * b.friction),
          .restitution = std::max(a.restitution, b.restitution),
          .inverse_a = a.inverse_mass,
          .inverse_b = b.inverse_mass,
          .slot_a = a.first_slot,
          .slot_b = b.first_slot,
          .overlap = range.a != range.b && (traits_[range.a].surface->closed() || traits_[range.b].surface->closed())};
}

/// Hands on what is remembered of the same features. Pairs that were near before know whether they overlap.
void SurfaceContact::inherit(const std::vector<Pair>& old_pairs, const std::vector<FeaturePair>& old_features,
                             const std::vector<Memory>& old_memory) {
  auto old = old_pairs.begin();
  const auto before = [](const collide::SurfacePair& x, const collide::SurfacePair& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  };
  const auto hand_on = [&](std::uint32_t from, std::uint32_t from_end, std::uint32_t to, std::uint32_t to_end) {
    for (; to < to_end; ++to) {
      while (from < from_end && old_features[from].key() < search_.features()[to].key()) ++from;
      if (from == from_end) return;
      if (old_features[from].key() == search_.features()[to].key()) memory_[to] = old_memory[from];
    }
  };
  for (Pair& p : pairs_) {
    while (old != old_pairs.end() && before(old->range, p.range)) ++old;
    if (old == old_pairs.end()) return;
    if (before(p.range, old->range)) continue;
    const collide::SurfacePair &from = old->range, &to = p.range;
    p.overlap = old->overlap;
    hand_on(from.vertex_face, from.face_vertex, to.vertex_face, to.face_vertex);
    hand_on(from.face_vertex, from.edge_edge, to.face_vertex, to.edge_edge);
    hand_on(from.edge_edge, from.end, to.edge_edge, to.end);
  }
}

/// Lists the vertices of two closed bodies that lie inside the other one, with the faces that they are closest to.
void SurfaceContact::find_deep(Pair& pair) {
  pair.deep = static_cast<std::uint32_t>(deep_.size());
  float deepest = 0;
  for (const bool of_b : {false, true}) {
    const Index own = of_b ? pair.range.b : pair.range.a, other = of_b ? pair.range.a : pair.range.b;
    if (!traits_[other].surface->closed()) continue;
    const collide::Run vertices = search_.run(own), shell = search_.run(other);
    const collide::Bound bound = collide::bound_of(shell);
    for (Index v = 0; v < vertices.size; ++v) {
      const glm::vec3 p(vertices.x[v], vertices.y[v], vertices.z[v]);
      if (!collide::near({p, p}, bound.box, 0.0f) || !collide::inside(p, *traits_[other].surface, shell)) continue;
      const collide::NearestFace nearest = collide::nearest_face(p, *traits_[other].surface, shell);
      deepest = std::max(deepest, nearest.distance);
      deep_.push_back({v, nearest.face, of_b});
    }
  }
  pair.overlap = deep_.size() > pair.deep;
  // Vertex by vertex, bodies far inside each other would only be pressed into nested cups.
  pair.parting = traits_[pair.range.a].surface->closed() && traits_[pair.range.b].surface->closed() &&
                 deepest > deep_share * std::min(traits_[pair.range.a].edge, traits_[pair.range.b].edge);
  if (pair.parting) deep_.resize(pair.deep);
  pair.deep_end = static_cast<std::uint32_t>(deep_.size());
}

/// Greedily, in order: pairs of one colour share no body. Those for which no colour is left come last, one by one.
void SurfaceContact::colour() {
  constexpr std::size_t most = 64;
  std::vector<std::uint64_t> taken(bodies_.size(), 0);
  colours_.clear();
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    std::uint64_t &a = taken[pairs_[i].range.a], &b = taken[pairs_[i].range.b];
    const auto free = static_cast<std::size_t>(std::countr_one(a | b));
    if (free == most) {
      rest.push_back(i);
      continue;
    }
    a |= std::uint64_t{1} << free;
    b |= std::uint64_t{1} << free;
    if (colours_.size() <= free) colours_.resize(free + 1);
    colours_[free].push_back(i);
  }
  for (const std::uint32_t i : rest) colours_.push_back({i});
}

SurfaceContact::Side SurfaceContact::side(const Pair& pair, bool second) const {
  if (second) return {traits_[pair.range.b].surface, pair.slot_b, pair.offset, pair.inverse_b};
  return {traits_[pair.range.a].surface, pair.slot_a, glm::vec3(0.0f), pair.inverse_a};
}

void SurfaceContact::prepare(int thread, int threads, Field<const float> x, Field<const float> v, float elapsed,
                             float h) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  own.rows.clear();
  const collide::Part part = collide::part_of(pairs_.size(), thread, threads);
  for (std::size_t i = part.begin; i < part.end; ++i) {
    Pair& p = pairs_[i];
    p.thread = thread;
    p.first_row = static_cast<std::uint32_t>(own.rows.size());
    Step step{x, v, h, elapsed + h, own, p, 1.1f * p.distance + h * p.speed, last_h_ > 0 ? h / last_h_ : 0};
    p.rows = 0;
    if (p.parting) continue;
    if (p.deep < p.deep_end) deep_vertices(step);
    vertices_on_faces(step, p.range.vertex_face, p.range.face_vertex, false);
    vertices_on_faces(step, p.range.face_vertex, p.range.edge_edge, true);
    if (p.deep == p.deep_end) edges_on_edges(step);
    p.rows = static_cast<std::uint32_t>(own.rows.size()) - p.first_row;
  }
}

namespace {

ContactRow corners_of(const Closest& c, std::size_t vertex_slot, float vertex_mobility, const collide::Triangle& face,
                      std::size_t face_slot, float face_mobility) {
  ContactRow row{};
  row.slot[0] = static_cast<std::uint32_t>(vertex_slot);
  row.weight[0] = 1;
  row.mobility[0] = vertex_mobility;
  for (std::size_t k = 0; k < 3; ++k) {
    row.slot[k + 1] = static_cast<std::uint32_t>(face_slot + face[k] * lanes);
    row.weight[k + 1] = -c.weight[k + 1];
    row.mobility[k + 1] = face_mobility * row.weight[k + 1];
  }
  return row;
}

}  // namespace

void SurfaceContact::vertices_on_faces(Step& step, std::uint32_t begin, std::uint32_t end, bool vertex_of_b) {
  const Side vertex_side = side(step.pair, vertex_of_b), face_side = side(step.pair, !vertex_of_b);
  const Side faces = step.pair.range.a == step.pair.range.b ? vertex_side : face_side;
  const bool oriented = step.pair.range.a == step.pair.range.b || !faces.surface->closed();
  const auto is_deep = [&](Index v) {
    return std::any_of(deep_.begin() + step.pair.deep, deep_.begin() + step.pair.deep_end,
                       [&](const DeepVertex& d) { return d.vertex == v && d.of_b == vertex_of_b; });
  };
  const auto& features = search_.features();
  const float look2 = step.look * step.look;
  for (std::uint32_t i = begin; i < end;) {
    const Index v = features[i].a;
    const glm::vec3 p = read(step.x, vertex_side.slot + v * lanes) + vertex_side.offset;
    step.own.near.clear();
    for (; i < end && features[i].a == v; ++i) {
      if (features[i].from > step.until) continue;
      const collide::Triangle& face = faces.surface->triangles()[features[i].b];
      glm::vec3 corner[3];
      for (std::size_t k = 0; k < 3; ++k) corner[k] = read(step.x, faces.slot + face[k] * lanes) + faces.offset;
      const Closest c = collide::closest_vertex_face(p, corner[0], corner[1], corner[2]);
      const float distance2 = glm::dot(c.apart, c.apart);
      if (distance2 > look2)
        memory_[i] = {};
      else
        step.own.near.push_back({c, normal_of(corner[0], corner[1], corner[2]), distance2, i});
    }
    if (!step.own.near.empty() && !is_deep(v)) vertex_on_faces(step, vertex_side, faces, oriented);
  }
}

/// The rows of one vertex, whose near faces are listed.
void SurfaceContact::vertex_on_faces(Step& step, const Side& vertex_side, const Side& face_side, bool oriented) {
  const auto& features = search_.features();
  const std::vector<Near>& near = step.own.near;
  const auto corners = [&](const Near& n) {
    const FeaturePair& f = features[n.feature];
    ContactRow row = corners_of(n.closest, vertex_side.slot + f.a * lanes, vertex_side.inverse_mass,
                                face_side.surface->triangles()[f.b], face_side.slot, face_side.inverse_mass);
    row.feature = n.feature;
    return row;
  };
  if (!oriented) {
    const auto facing = [](const Near& n) {  // |cos| of the angle between the face's normal and the way to the vertex
      return std::abs(glm::dot(n.closest.apart, n.face_normal)) / glm::length(n.face_normal);
    };
    const Near* nearest = &near[0];
    for (const Near& n : near) {
      // Faces that share the closest point: the one that faces the vertex most tells which side it is on.
      const bool tie = std::abs(n.distance2 - nearest->distance2) <= 1e-5f * nearest->distance2;
      if (tie ? facing(n) > facing(*nearest) : n.distance2 < nearest->distance2) nearest = &n;
    }
    if (glm::dot(nearest->closest.apart, nearest->face_normal) < 0) {
      const float depth = std::sqrt(nearest->distance2);
      for (const Near& n : near)
        memory_[n.feature].pressed = n.feature == nearest->feature ? memory_[n.feature].pressed : 0;
      if (depth > step.pair.distance) step.pair.overlap = true;  // to be looked at when candidates are found next
      add_row(step, corners(*nearest), unit(-nearest->closest.apart, nearest->face_normal), -depth,
              memory_[nearest->feature]);
      return;
    }
  }
  for (std::size_t k = 0; k < near.size(); ++k) {
    const Near& n = near[k];
    Memory& memory = memory_[n.feature];
    const bool twice =
        !n.closest.inner && std::any_of(near.begin(), near.begin() + std::ptrdiff_t(k), [&](const Near& m) {
          const glm::vec3 d = m.closest.apart - n.closest.apart;
          return glm::dot(d, d) <= 1e-6f * n.distance2;
        });
    if (twice) {
      memory = {};
      continue;
    }
    glm::vec3 normal = unit(n.closest.apart, oriented ? memory.normal : n.face_normal);
    const bool crossed = oriented && orient(memory, n.closest.inner, normal);
    add_row(step, corners(n), normal, std::sqrt(n.distance2) * (crossed ? -1.0f : 1.0f), memory);
  }
}

/// Turns the normal to the side that is remembered; true if that is not the one it is on now.
bool SurfaceContact::orient(Memory& memory, bool inner, glm::vec3& normal) const {
  const bool crossed = inner && glm::dot(memory.normal, normal) < 0;
  if (crossed) normal = -normal;
  memory.normal = inner ? normal : glm::vec3(0.0f);
  return crossed;
}

/// Those deep inside another body: towards the plane of the face that they are closest to.
void SurfaceContact::deep_vertices(Step& step) {
  for (std::uint32_t i = step.pair.deep; i < step.pair.deep_end; ++i) {
    const DeepVertex& d = deep_[i];
    const Side vertex_side = side(step.pair, d.of_b), face_side = side(step.pair, !d.of_b);
    const collide::Triangle& face = face_side.surface->triangles()[d.face];
    glm::vec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = read(step.x, face_side.slot + face[k] * lanes) + face_side.offset;
    const glm::vec3 p = read(step.x, vertex_side.slot + d.vertex * lanes) + vertex_side.offset;
    const Closest c = collide::closest_vertex_face(p, corner[0], corner[1], corner[2]);
    const glm::vec3 normal = unit(normal_of(corner[0], corner[1], corner[2]), {});
    ContactRow row = corners_of(c, vertex_side.slot + d.vertex * lanes, vertex_side.inverse_mass, face, face_side.slot,
                                face_side.inverse_mass);
    row.feature = forgotten;
    Memory none;
    add_row(step, row, normal, glm::dot(p - corner[0], normal), none);
  }
}

void SurfaceContact::edges_on_edges(Step& step) {
  const collide::SurfacePair& range = step.pair.range;
  const bool self = range.a == range.b;
  const Side one = side(step.pair, false), two = self ? one : side(step.pair, true);
  const bool closed = !self && one.surface->closed() && two.surface->closed();
  const float look2 = step.look * step.look;
  const auto at = [&](const Side& s, Index v) { return read(step.x, s.slot + v * lanes) + s.offset; };
  const auto outward = [&](const Side& s, Index edge) {
    glm::vec3 sum(0.0f);
    for (const Index f : s.surface->edge_triangles()[edge]) {
      const collide::Triangle& face = s.surface->triangles()[f];
      sum += unit(normal_of(at(s, face[0]), at(s, face[1]), at(s, face[2])), {});
    }
    return sum;
  };
  for (std::uint32_t i = range.edge_edge; i < range.end; ++i) {
    const FeaturePair& f = search_.features()[i];
    if (f.from > step.until) continue;
    const collide::Edge &e1 = one.surface->edges()[f.a], &e2 = two.surface->edges()[f.b];
    const Closest c = collide::closest_edges(at(one, e1[0]), at(one, e1[1]), at(two, e2[0]), at(two, e2[1]));
    const float distance2 = glm::dot(c.apart, c.apart);
    Memory& memory = memory_[i];
    if (!c.inner || distance2 > look2) {  // those that end on a corner are a vertex's
      memory = {};
      continue;
    }
    ContactRow row{};
    for (std::size_t k = 0; k < 2; ++k) {
      row.slot[k] = static_cast<std::uint32_t>(one.slot + e1[k] * lanes);
      row.slot[k + 2] = static_cast<std::uint32_t>(two.slot + e2[k] * lanes);
      row.weight[k] = c.weight[k];
      row.weight[k + 2] = -c.weight[k + 2];
      row.mobility[k] = one.inverse_mass * row.weight[k];
      row.mobility[k + 2] = two.inverse_mass * row.weight[k + 2];
    }
    row.feature = i;
    const float distance = std::sqrt(distance2);
    glm::vec3 normal = unit(c.apart, memory.normal);
    bool crossed = false;
    if (!closed) {
      crossed = orient(memory, true, normal);
    } else if (glm::dot(memory.normal, normal) <= 0.5f) {  // else they are on the sides that they were on before
      crossed = glm::dot(normal, outward(two, f.b) - outward(one, f.a)) < 0;
      if (crossed && distance > step.pair.distance) {  // the far side of something thin
        memory = {};
        continue;
      }
      memory.normal = crossed ? glm::vec3(0.0f) : normal;
      if (crossed) normal = -normal;
    }
    add_row(step, row, normal, crossed ? -distance : distance, memory);
  }
}

/// Adds a row, unless neither side moves. apart: between the surfaces, negative where they overlap.
void SurfaceContact::add_row(Step& step, const ContactRow& corners, const glm::vec3& normal, float apart,
                             Memory& memory) {
  float mobility = 0;
  for (std::size_t k = 0; k < 4; ++k) mobility += corners.weight[k] * corners.mobility[k];
  if (mobility <= 0) return;
  const float speed = glm::dot(relative_velocity(corners, step.v), normal);
  const float room = corners.feature == forgotten ? step.pair.distance : room_[corners.feature];
  const float distance = std::min(step.pair.distance, room), gap = apart - distance;
  ContactRow& row = step.own.rows.emplace_back(corners);
  row.normal = normal;
  row.mass = 1 / mobility;
  // A spring and damper hold the distance; half of it is never given up, and what overlaps is pushed out.
  const float spare = apart - 0.5f * distance;
  row.target = spare > 0 ? -spare / step.h : std::min(-push_share * spare / step.h, push_speed);
  const float turn = step.h * std::min(spring_frequency, 0.25f * 2 * glm::pi<float>() / step.h);
  row.hardness = gap < 0 ? turn * (2 * spring_damping + turn) : 0;
  row.widening = -gap * turn / ((2 * spring_damping + turn) * step.h);
  const bool impact = memory.pressed == 0 && speed < -impact_speed && gap + step.h * speed < 0;
  if (impact && step.pair.restitution > 0) row.target = std::max(row.target, -step.pair.restitution * speed);
  row.friction = step.pair.friction;
  row.pressed = step.same * memory.pressed;
  row.drag = step.same * (memory.drag - glm::dot(memory.drag, normal) * normal);
}

namespace {

void apply(const ContactRow& row, const glm::vec3& impulse, Field<float> v) {
  for (std::size_t k = 0; k < 4; ++k) add(v, row.slot[k], row.mobility[k] * impulse);
}

void iterate(ContactRow& row, Field<float> v) {
  glm::vec3 velocity = relative_velocity(row, v);
  const float speed = glm::dot(velocity, row.normal);
  const float held = row.hardness / (1 + row.hardness) * (row.pressed + row.mass * (row.widening - speed));
  const float pressed = std::max({0.0f, held, row.pressed + row.mass * (row.target - speed)});
  const float push = pressed - row.pressed;
  row.pressed = pressed;
  velocity += (push / row.mass) * row.normal;
  const glm::vec3 slip = velocity - glm::dot(velocity, row.normal) * row.normal;
  glm::vec3 drag = row.drag - row.mass * slip;
  if (const float size = glm::length(drag), limit = row.friction * pressed; size > limit) drag *= limit / size;
  if (row.pressed > 0 || push != 0) apply(row, push * row.normal + (drag - row.drag), v);
  row.drag = drag;
}

}  // namespace

/// Two bodies far inside each other move apart along the line of their centres, each as a whole: their shapes, momentum
/// and angular momentum stay.
void SurfaceContact::separate(const Pair& pair, Field<const float> x, Field<float> v) const {
  struct Whole {
    glm::vec3 centre{0.0f}, velocity{0.0f};
    float inverse_mass = 0;
  };
  const auto whole = [&](const Side& s) {
    Whole w;
    const Index count = s.surface->vertex_count();
    for (Index i = 0; i < count; ++i) {
      w.centre += (read(x, s.slot + i * lanes) + s.offset) / static_cast<float>(count);
      w.velocity += read(v, s.slot + i * lanes) / static_cast<float>(count);
    }
    w.inverse_mass = s.inverse_mass / static_cast<float>(count);
    return w;
  };
  const Side one = side(pair, false), two = side(pair, true);
  const Whole a = whole(one), b = whole(two);
  const glm::vec3 axis = unit(a.centre - b.centre, {});
  const float missing = push_speed - glm::dot(a.velocity - b.velocity, axis);
  if (missing <= 0) return;
  const float impulse = missing / (a.inverse_mass + b.inverse_mass);
  for (Index i = 0; i < one.surface->vertex_count(); ++i) add(v, one.slot + i * lanes, impulse * a.inverse_mass * axis);
  for (Index i = 0; i < two.surface->vertex_count(); ++i)
    add(v, two.slot + i * lanes, -impulse * b.inverse_mass * axis);
}

void SurfaceContact::solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
                           const std::function<void()>& barrier) {
  constexpr std::size_t few = 2000;  // rows: done before the threads have met at every colour
  const bool alone = rows() < few;
  const auto pass = [&](const auto& visit, bool parting = false) {
    for (const auto& colour : colours_) {
      const collide::Part part =
          alone ? collide::Part{0, thread == 0 ? colour.size() : 0} : collide::part_of(colour.size(), thread, threads);
      for (std::size_t i = part.begin; i < part.end; ++i) {
        const Pair& p = pairs_[colour[i]];
        if (parting && p.parting) separate(p, x, v);
        for (std::uint32_t r = p.first_row; r < p.first_row + p.rows; ++r)
          visit(threads_[static_cast<std::size_t>(p.thread)].rows[r]);
      }
      if (!alone) barrier();
    }
  };
  pass([&](ContactRow& row) {
    if (row.pressed > 0) apply(row, row.pressed * row.normal + row.drag, v);
  });
  const int rounds = h * rate_ > 0.5f ? iterations_of_hits : iterations;
  for (int i = 1; i < rounds; ++i) pass([&](ContactRow& row) { iterate(row, v); }, true);
  pass(
      [&](ContactRow& row) {
        iterate(row, v);
        if (row.feature == forgotten) return;
        memory_[row.feature].pressed = row.pressed;
        memory_[row.feature].drag = row.drag;
      },
      true);
  if (thread == 0) last_h_ = h;
  if (alone) barrier();
}

std::size_t SurfaceContact::rows() const {
  std::size_t sum = 0;
  for (const Pair& p : pairs_) sum += p.rows;
  return sum;
}

std::vector<collide::ItemPair> SurfaceContact::touching() const {
  std::vector<collide::ItemPair> list;
  for (const Pair& p : pairs_) {
    if (p.range.a == p.range.b) continue;
    const auto& rows = threads_[static_cast<std::size_t>(p.thread)].rows;
    const auto first = rows.begin() + p.first_row;
    if (std::any_of(first, first + p.rows, [](const ContactRow& r) { return r.pressed > 0; }))
      list.push_back({p.range.a, p.range.b});
  }
  return list;
}

/// The body of the pair that a slot belongs to.
Index SurfaceContact::owner(const Pair& pair, std::uint32_t slot) const {
  const std::size_t first = bodies_[pair.range.a].first_slot;
  const std::size_t end = first + lanes * traits_[pair.range.a].surface->vertex_count();
  return slot >= first && slot < end && (slot - first) % lanes == 0 ? pair.range.a : pair.range.b;
}

std::vector<SurfaceTouch> SurfaceContact::touches(const collide::Bodies& vertices) const {
  std::vector<SurfaceTouch> list;
  for (const Pair& p : pairs_) {
    const auto& rows = threads_[static_cast<std::size_t>(p.thread)].rows;
    for (std::uint32_t r = p.first_row; r < p.first_row + p.rows; ++r) {
      const ContactRow& row = rows[r];
      if (row.pressed <= 0) continue;
      SurfaceTouch& touch =
          list.emplace_back(SurfaceTouch{owner(p, row.slot[0]), owner(p, row.slot[3]), {}, row.weight, row.normal});
      for (std::size_t k = 0; k < 4; ++k) {
        const Index body = owner(p, row.slot[k]);
        const std::size_t local = (row.slot[k] - bodies_[body].first_slot) / lanes;
        touch.vertex[k] = vertices.first[body] + static_cast<Index>(local);
      }
    }
  }
  return list;
}

}  // namespace softbody
