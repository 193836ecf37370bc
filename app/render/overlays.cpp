#include "app/render/overlays.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/render/palette.h"
#include "app/render/scene_view.h"
#include "softbody/forces/springs.h"
#include "softbody/world/measures.h"

namespace app::render {
namespace {

using Points = std::span<const glm::vec3>;
using Legend = std::vector<LegendLine>;

// Share of its opacity that an overlay keeps where a surface is in front of it. The eye must tell the front from what
// is behind, and yet find what lies only behind.
constexpr float hidden = 0.0f;         // for lines all over a body
constexpr float faint = 0.12f;         // for what fills the scene
constexpr float half_hidden = 0.3f;    // for contacts, most of which lie behind a surface: where bodies press together
constexpr float seen_through = 0.45f;  // for the few that must be found: chosen with the mouse, or missed

constexpr std::size_t max_boxes = 20'000;  // of each kind; the others are not drawn
constexpr float max_shown_strain = 0.2f;   // change of length / rest length at the ends of the colour scale

/// Lines and points that look alike, added to the frame. Valid until another set is added to it.
struct LinesAndPoints {
  LinesAndPoints(engine::FrameData& frame, float width, float diameter, float occluded_alpha)
      : lines(frame.lines.emplace_back(engine::LineSet{{}, width, occluded_alpha}).lines),
        points(frame.points.emplace_back(engine::PointSet{{}, diameter, occluded_alpha}).points) {}

  std::vector<engine::Line>& lines;
  std::vector<engine::Point>& points;
};

void add_body_boxes(const OverlayInput& from, engine::FrameData& frame) {
  engine::BoxSet& set = frame.boxes.emplace_back(engine::BoxSet{{}, 1.5f, faint});
  if (from.request.shown.boxes) set.face_alpha = 0;  // these tint the same place
  const collide::Bodies& bodies = from.world.bodies();
  for (collide::Index b = 0; b < bodies.count(); ++b) {
    glm::vec3 lo(std::numeric_limits<float>::max()), hi(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : from.shown.subspan(bodies.first[b], bodies.size(b))) {
      lo = glm::min(lo, p);
      hi = glm::max(hi, p);
    }
    set.boxes.push_back({lo, hi, glm::vec4(body_colour(from.world.body(b).number) * 0.72f, 0.95f)});
  }
}

/// Adds the boxes in the colours of the buckets of their minimum corners.
void add_boxes(const OverlayInput& from, engine::FrameData& frame) {
  if (!from.request.debug) return;
  const collide::DebugGeometry& debug = *from.request.debug;
  engine::BoxSet& set = frame.boxes.emplace_back(
      engine::BoxSet{.boxes = {}, .occluded_alpha = faint, .face_alpha = from.request.bucket ? 0.0f : 0.05f});
  const float alpha = from.request.bucket ? 0.15f : 0.85f;
  for (std::size_t i = 0; i < std::min(debug.boxes.size(), max_boxes); ++i) {
    const auto& [lo, hi, body] = debug.boxes[i];
    set.boxes.push_back({lo, hi, glm::vec4(bucket_colour(debug.box_bucket[debug.box_first[i]]), alpha)});
  }
}

Legend boxes_legend(const LegendFacts& facts) {
  const bool none = !facts.debug || facts.debug->boxes.empty();
  return {{none ? "This method has no boxes" : "Boxes of one colour share a bucket"}};
}

/// Adds the content of a bucket and its cells: one cell in one colour; what shares only the bucket in another.
void add_bucket(const OverlayInput& from, engine::FrameData& frame) {
  const OverlayRequest& request = from.request;
  if (!request.debug || !request.bucket) return;
  const compare::CellGroup* reference = request.bucket->group(request.bucket_cell);
  engine::BoxSet boxes{.boxes = {}, .width = 2.5f, .occluded_alpha = seen_through, .face_alpha = 0.22f};
  engine::BoxSet cells{.boxes = {}, .width = 1.5f, .occluded_alpha = half_hidden, .face_alpha = 0.08f};
  engine::PointSet& points =
      frame.points.emplace_back(engine::PointSet{.points = {}, .diameter = 7.0f, .occluded_alpha = seen_through});
  for (const compare::CellGroup& group : request.bucket->groups) {
    const glm::vec3 colour = &group == reference ? same_cell_colour : aliased_colour;
    cells.boxes.push_back(cell_box(group.cell, *from.world.collision().cell_size, glm::vec4(colour * 0.6f, 0.9f)));
    for (const collide::Index item : group.items) {
      if (request.bucket->vertices) {
        points.points.push_back({from.shown[item], glm::vec4(colour, 1.0f)});
      } else {
        const auto& [lo, hi, body] = request.debug->boxes[item];
        boxes.boxes.push_back({lo, hi, glm::vec4(colour * 0.9f, 1.0f)});
      }
    }
  }
  frame.boxes.push_back(std::move(cells));
  frame.boxes.push_back(std::move(boxes));
}

void add_areas(const OverlayInput& from, engine::FrameData& frame) {
  const std::vector<collide::DebugGeometry::Box>& areas = from.request.areas;
  engine::BoxSet& set = frame.boxes.emplace_back(
      engine::BoxSet{.boxes = {}, .width = 1.5f, .occluded_alpha = half_hidden, .face_alpha = 0.12f});
  for (const auto& [lo, hi, body] : std::span(areas).first(std::min(areas.size(), max_boxes)))
    set.boxes.push_back({lo, hi, glm::vec4(area_colour, 0.9f)});
}

Legend areas_legend(const LegendFacts&) { return {{"area that the exact method searches", area_colour}}; }

void add_cells(const OverlayInput& from, engine::FrameData& frame) {
  if (!from.request.debug) return;
  engine::BoxSet& set =
      frame.boxes.emplace_back(engine::BoxSet{.boxes = {}, .width = 1.0f, .occluded_alpha = faint, .face_alpha = 0});
  for (const collide::DebugGeometry::Cell& cell : from.request.debug->cells) {
    if (set.boxes.size() == max_boxes) break;
    set.boxes.push_back(cell_box(cell.index, *from.world.collision().cell_size, glm::vec4(cell_colour, 0.6f)));
  }
}

Legend cells_legend(const LegendFacts&) { return {{"occupied cell", cell_colour}}; }

void add_contact(Points positions, const collide::Contact& contact, const glm::vec3& colour, auto& marks) {
  const glm::vec3 a = positions[contact.a], b = positions[contact.b];
  marks.lines.push_back({a, b, glm::vec4(colour, 0.9f)});
  for (const glm::vec3& end : {a, b}) marks.points.push_back({end, glm::vec4(colour, 1.0f)});
}

/// Adds the contacts with points of 1 to 5 pixels, at most as large as the distance between vertices, so that a fine
/// mesh can be seen between them.
void add_contacts(const OverlayInput& from, engine::FrameData& frame) {
  struct Marks {
    std::vector<engine::Line> lines;
    std::vector<engine::Point> points;
  };
  std::array<Marks, 5> marks;  // by the diameter of their points
  const collide::Bodies &bodies = from.world.bodies(), &particles = *from.world.simulated().positions.bodies;
  const auto marks_at = [&](const glm::vec3& at, const softbody::BodyMesh& mesh) -> Marks& {
    float pixels = 5;  // vertices without edges have no such distance
    if (mesh.mean_edge > 0)
      pixels = static_cast<float>(mesh.mean_edge) * from.pixels_at_one_metre / glm::distance(at, from.eye);
    return marks[static_cast<std::size_t>(std::min(std::max(1.0f, pixels), 5.0f)) - 1];
  };
  for (const collide::Contact& contact : from.world.detection().contacts) {
    const softbody::BodyId body = bodies.body_of(contact.a);
    const bool inside = body == bodies.body_of(contact.b);
    add_contact(from.shown, contact, inside ? contact_inside_colour : contact_between_colour,
                marks_at(from.shown[contact.a], from.world.model(body).shown()));
  }
  for (const softbody::SolidContactPoint& contact : from.request.solid_contacts) {
    const glm::vec3& at = from.simulated[contact.vertex];
    marks_at(at, from.world.model(particles.body_of(contact.vertex)))
        .points.push_back({at, glm::vec4(contact_solid_colour, 1.0f)});
  }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const float diameter = static_cast<float>(i + 1);
    frame.lines.push_back({std::move(marks[i].lines), 0.4f * diameter, half_hidden});
    frame.points.push_back({std::move(marks[i].points), diameter, half_hidden});
  }
}

Legend contacts_legend(const LegendFacts&) {
  return {{"contact between bodies", contact_between_colour},
          {"contact inside one body", contact_inside_colour},
          {"contact with a solid", contact_solid_colour}};
}

void add_missed(const OverlayInput& from, engine::FrameData& frame) {
  if (!from.request.missed) return;
  LinesAndPoints marks(frame, 3.0f, 7.0f, seen_through);
  for (const collide::Contact& contact : *from.request.missed)
    add_contact(from.shown, contact, contact_missed_colour, marks);
  if (from.request.false_found) add_contact(from.shown, *from.request.false_found, contact_false_colour, marks);
}

Legend missed_legend(const LegendFacts& facts) {
  const bool none = facts.missed && facts.missed->empty();
  return {{fmt::format("{} by {}", none ? "none missed" : "missed", facts.misses_of), contact_missed_colour}};
}

/// Adds both closest points, and the normal at the second one, half a mean edge long.
void add_surface_contacts(const OverlayInput& from, engine::FrameData& frame) {
  LinesAndPoints marks(frame, 2.0f, 5.0f, half_hidden);
  for (const softbody::SurfaceContactPoint& contact : from.request.surface_contacts) {
    glm::vec3 first(0.0f), second(0.0f);
    for (std::size_t k = 0; k < contact.vertex.size(); ++k)
      (contact.weight[k] > 0 ? first : second) += std::abs(contact.weight[k]) * from.simulated[contact.vertex[k]];
    const glm::vec4 colour(contact.a == contact.b ? contact_inside_colour : contact_between_colour, 1.0f);
    const float length = 0.5f * static_cast<float>(from.world.model(contact.a).mean_edge);
    marks.lines.push_back({second, second + length * contact.normal, colour});
    marks.points.push_back({first, colour});
    marks.points.push_back({second, colour});
  }
}

Legend surface_contacts_legend(const LegendFacts& facts) {
  if (facts.world.scene().contact_surface != softbody::ContactSurface::surfaces)
    return {{.text = "No surface contacts (F: next contact)", .pale = true}};
  return {{"surface contact between bodies, with normal", contact_between_colour},
          {"surface contact inside one body", contact_inside_colour}};
}

/// Widens the regions of marked vertices (value 1, others 0) by about an edge of the mesh, with a smooth border: it
/// lies where a mean of the values falls to a fifth.
void widen(const collide::surface::Surface& surface, std::span<float> marks) {
  const std::vector<float> marked(marks.begin(), marks.end());
  std::vector<float> sum(marks.size()), count(marks.size());
  for (int round = 0; round < 2; ++round) {  // in each, a vertex takes the mean of itself and its neighbours
    std::ranges::copy(marks, sum.begin());
    std::ranges::fill(count, 1.0f);
    for (const auto& [a, b] : surface.edges()) {
      sum[a] += marks[b];
      sum[b] += marks[a];
      ++count[a];
      ++count[b];
    }
    for (std::size_t v = 0; v < marks.size(); ++v) marks[v] = sum[v] / count[v];
  }
  for (std::size_t v = 0; v < marks.size(); ++v) marks[v] = std::max(marked[v], 2.5f * marks[v]);
}

/// Brings the marks of a body's particles, widened, to the vertices that are drawn.
void spread(const softbody::BodyModel& model, std::span<float> particles, std::span<float> drawn) {
  widen(*model.surface, particles);
  if (!model.fine) {
    std::ranges::copy(particles, drawn.begin());
    return;
  }
  const softbody::Embedding& embedding = model.fine->embedding();
  for (std::size_t v = 0; v < drawn.size(); ++v)
    for (int k = 0; k < 3; ++k)
      drawn[v] += embedding[v].weight[k] * particles[embedding[v].corner[static_cast<std::size_t>(k)]];
}

/// Marks the regions of the surfaces that are inside other bodies or pierce them, with a margin that is outside and so
/// in sight. Adds the deepest vertex of each pair of bodies, joined to the nearest point of the surface.
void add_marks(const OverlayInput& from, engine::FrameData& frame) {
  const softbody::BodiesInMotion& world = from.world;
  const Points particles = from.simulated;
  frame.mark_colour = contact_missed_colour;
  frame.marks.assign(frame.positions.size(), 0.0f);
  const collide::Bodies& bodies = *world.simulated().positions.bodies;
  std::vector<float> marked_particles(particles.size(), 0.0f);
  std::map<std::pair<softbody::BodyId, softbody::BodyId>, const compare::SurfaceMark*> deepest;
  std::set<softbody::BodyId> marked;
  for (const compare::SurfaceMark& mark : from.request.marks) {
    assert(mark.vertex < particles.size());
    const softbody::BodyId body = bodies.body_of(mark.vertex);
    marked_particles[mark.vertex] = 1.0f;
    marked.insert(body);
    if (mark.piercing) continue;
    const compare::SurfaceMark*& deepest_here = deepest[std::minmax(body, softbody::BodyId{mark.body})];
    if (!deepest_here || glm::length(deepest_here->offset) < glm::length(mark.offset)) deepest_here = &mark;
  }
  for (const softbody::BodyId body : marked)
    spread(world.model(body), std::span(marked_particles).subspan(bodies.first[body], bodies.size(body)),
           std::span(frame.marks).subspan(world.bodies().first[body], world.bodies().size(body)));
  LinesAndPoints drawn(frame, 1.5f, 4.5f, half_hidden);
  const glm::vec4 colour(contact_missed_colour, 1.0f);
  for (const auto& [pair, mark] : deepest) {
    const glm::vec3 vertex = particles[mark->vertex];
    drawn.lines.push_back({vertex, vertex + mark->offset, colour});
    drawn.points.push_back({vertex, colour});
  }
}

bool is_open(const softbody::BodyModel& model) { return !(model.start_volume > 0); }

/// Returns for each vertex of a body whether one of its faces is turned to the eye; always true for an open body, which
/// shows both sides.
std::vector<char> vertices_in_sight(const softbody::BodyModel& model, Points body, const glm::vec3& eye) {
  std::vector<char> in_sight(body.size(), is_open(model));
  if (is_open(model)) return in_sight;
  for (const auto& [a, b, c] : model.mesh.triangles) {
    if (glm::dot(glm::cross(body[b] - body[a], body[c] - body[a]), eye - body[a]) <= 0) continue;
    in_sight[a] = in_sight[b] = in_sight[c] = true;
  }
  return in_sight;
}

void add_springs(const std::vector<softbody::Spring>& springs, Points body, const std::vector<char>& in_sight,
                 float alpha, engine::LineSet& set) {
  for (const softbody::Spring& spring : springs) {
    if (!in_sight[spring.i] || !in_sight[spring.j]) continue;  // behind its own body: half of all lines
    const glm::vec3 a = body[spring.i], b = body[spring.j];
    const float strain = glm::distance(a, b) / static_cast<float>(spring.rest) - 1.0f;
    set.lines.push_back({a, b, glm::vec4(diverging_colour(strain / max_shown_strain), alpha)});
  }
}

/// Returns true if the body is so large on the screen that its other springs can be told from those along edges.
bool is_near(const softbody::BodyModel& model, Points body, const OverlayInput& from) {
  constexpr float min_edge = 20;  // pixels
  const float edge = static_cast<float>(model.mean_edge);
  return edge * from.pixels_at_one_metre > min_edge * glm::distance(body.front(), from.eye);
}

void add_all_springs(const OverlayInput& from, engine::FrameData& frame) {
  const softbody::BodiesInMotion& world = from.world;
  engine::LineSet structural{.lines = {}, .width = 1.75f, .occluded_alpha = hidden};
  engine::LineSet others{.lines = {}, .width = 1.0f, .occluded_alpha = hidden};
  const collide::Bodies& bodies = *world.simulated().positions.bodies;
  for (collide::Index b = 0; b < bodies.count(); ++b) {
    const softbody::BodyModel& model = world.model(b);
    const Points body = from.simulated.subspan(bodies.first[b], bodies.size(b));
    const std::vector<char> in_sight = vertices_in_sight(model, body, from.eye);
    add_springs(softbody::springs<softbody::StructuralSprings>(model), body, in_sight, 1.0f, structural);
    if (!is_near(model, body, from)) continue;
    add_springs(softbody::springs<softbody::BendSprings>(model), body, in_sight, 0.45f, others);
    add_springs(softbody::springs<softbody::ShearSprings>(model), body, in_sight, 0.7f, others);
  }
  frame.lines.push_back(std::move(others));
  frame.lines.push_back(std::move(structural));
}

Legend springs_legend(const LegendFacts&) {
  return {{"Strain of the springs"},
          {.text = fmt::format("-{:.0f} %", 100 * max_shown_strain),
           .pale = true,
           .scale = [](float share) { return diverging_colour(2 * share - 1); },
           .end = fmt::format("+{:.0f} %", 100 * max_shown_strain)}};
}

/// Adds the borders, and the edges between a face that is turned to the eye and one that is not. They lie a little
/// outside, because the body is drawn rounder than its mesh.
void add_outline(const softbody::BodiesInMotion& world, softbody::BodyId id, const glm::vec3& eye, Points positions,
                 const glm::vec3& colour, engine::LineSet& lines) {
  constexpr float outside = 0.08f;  // of the length of an edge
  const collide::surface::Surface& surface = *world.model(id).shown().surface;
  const Points body = positions.subspan(world.bodies().first[id], world.bodies().size(id));
  const auto normal_of = [&](collide::Index face) {  // twice as long as its area
    const auto& [a, b, c] = surface.triangles()[face];
    return glm::cross(body[b] - body[a], body[c] - body[a]);
  };
  const auto faces_eye = [&](collide::Index face) {
    return glm::dot(normal_of(face), eye - body[surface.triangles()[face][0]]) > 0;
  };
  for (std::size_t e = 0; e < surface.edges().size(); ++e) {
    const auto [one, other] = surface.edge_triangles()[e];
    if (one != other && faces_eye(one) == faces_eye(other)) continue;
    const auto [a, b] = surface.edges()[e];
    glm::vec3 normal = normal_of(one) + normal_of(other);
    if (one == other && !faces_eye(one)) normal = -normal;  // a border seen from behind
    const float length2 = glm::dot(normal, normal);
    const glm::vec3 out =
        length2 > 0 ? normal * (outside * glm::distance(body[a], body[b]) / std::sqrt(length2)) : glm::vec3(0);
    lines.lines.push_back({body[a] + out, body[b] + out, glm::vec4(colour, 1.0f)});
  }
}

/// Adds fine outlines to open bodies, which show little shade, and a bold one to the selected body.
void add_outlines(const OverlayInput& from, engine::FrameData& frame) {
  const softbody::BodiesInMotion& world = from.world;
  const OverlayRequest& request = from.request;
  engine::LineSet fine{.lines = {}, .width = 1.25f, .occluded_alpha = hidden};
  engine::LineSet bold{.lines = {}, .width = 3.0f, .occluded_alpha = seen_through};
  for (softbody::BodyId body = 0; body < world.bodies().count(); ++body) {
    if (body == request.selected_body)
      add_outline(world, body, from.eye, from.shown, hand_colour, bold);
    else if (is_open(world.model(body)) && !(request.highlight && request.highlight->fades(body)))
      add_outline(world, body, from.eye, from.shown, 0.5f * body_colour(world.body(body).number), fine);
  }
  frame.lines.push_back(std::move(fine));
  frame.lines.push_back(std::move(bold));
}

/// Adds a point at each particle that is held.
void add_held(const OverlayInput& from, engine::FrameData& frame) {
  engine::PointSet held{.points = {}, .diameter = 6.0f, .occluded_alpha = half_hidden};
  const collide::Bodies& bodies = *from.world.simulated().positions.bodies;
  for (collide::Index b = 0; b < bodies.count(); ++b)
    for (const collide::Index i : from.world.held(b))
      held.points.push_back({from.simulated[bodies.first[b] + i], glm::vec4(hand_colour, 1.0f)});
  if (!held.points.empty()) frame.points.push_back(std::move(held));
}

/// Adds the spring of the mouse: from the point that it holds to its target.
void add_grab(const OverlayInput& from, engine::FrameData& frame) {
  if (!from.request.grab || from.request.grab->body >= from.world.bodies().count()) return;
  const softbody::Grab& grab = *from.request.grab;
  const std::uint32_t first = from.world.simulated().positions.bodies->first[grab.body];
  glm::vec3 held(0.0f);
  for (int i = 0; i < 3; ++i)
    held += static_cast<float>(grab.weights[i]) * from.simulated[first + grab.corners[static_cast<std::size_t>(i)]];
  const glm::vec4 colour(hand_colour, 1.0f);
  const glm::vec3 target(grab.target);
  frame.lines.push_back({.lines = {{held, target, colour}}, .width = 2.5f, .occluded_alpha = seen_through});
  frame.points.push_back(
      {.points = {{held, colour}, {target, colour}}, .diameter = 9.0f, .occluded_alpha = seen_through});
}

constexpr std::array rows{
    OverlayRow{"body-boxes", "Body boxes", '1', "The bounding box of each body, in the body's colour (§2.1).",
               &Overlays::body_boxes, add_body_boxes, nullptr, 0},
    OverlayRow{
        "boxes", "Subdivided boxes", '2',
        "The boxes that the method hashes (§2.1). The colour is that of the bucket of the box's minimum corner (§2.2).",
        &Overlays::boxes, add_boxes, boxes_legend, 1, OverlayBasis::table},
    OverlayRow{"cells", "Occupied cells", '3', "The grid cells with at least one entry in the hash table (§2.2).",
               &Overlays::cells, add_cells, cells_legend, 0, OverlayBasis::table},
    OverlayRow{"contacts", "Contacts", '4',
               "Pairs of vertices closer than the tolerance, and vertices that touch a solid (§2.3).",
               &Overlays::contacts, add_contacts, contacts_legend},
    OverlayRow{"springs", "Springs", '5',
               "All springs, coloured by their strain. From far away only the springs along edges are drawn.",
               &Overlays::springs, add_all_springs, springs_legend, 0, OverlayBasis::picture, true},
    OverlayRow{"missed", "Missed contacts", '6',
               "True contacts that the paper's method misses, or the method that you choose in the comparison (V), and "
               "the first false one that it finds. A ring shows where, and how many.",
               &Overlays::missed, add_missed, missed_legend},
    OverlayRow{"areas", "Areas searched", '7',
               "Where the exact method searches for contacts between two bodies (§2.1, §5).", &Overlays::areas,
               add_areas, areas_legend, 2, OverlayBasis::present},
    OverlayRow{
        "touches", "Surface contacts", '8',
        "The two closest points and the normal of each surface contact. There are none with vertex-vertex contact, and "
        "none between bodies that sleep.",
        &Overlays::surface_contacts, add_surface_contacts, surface_contacts_legend, 2, OverlayBasis::picture, true},
    OverlayRow{
        "true-surfaces", "True surfaces", '9',
        "Checks the surfaces exactly: counts the vertices inside other bodies, and hatches where surfaces overlap and "
        "the method found no contact.",
        &Overlays::true_surfaces, add_marks},
};

}  // namespace

constinit const std::span<const OverlayRow> overlay_table(rows);

bool shows(const Overlays& shown, OverlayBasis basis) {
  return std::ranges::any_of(overlay_table,
                             [&](const OverlayRow& row) { return row.basis >= basis && shown.*row.shown; });
}

engine::Box cell_box(const compare::Cell& cell, const glm::vec3& size, const glm::vec4& colour) {
  const glm::vec3 at(static_cast<float>(cell[0]), static_cast<float>(cell[1]), static_cast<float>(cell[2]));
  return {at * size, (at + 1.0f) * size, colour};
}

void add_overlays(const OverlayInput& from, engine::FrameData& frame) {
  assert(from.shown.size() == from.world.bodies().vertex_count());
  for (const int layer : {0, 1, 2}) {
    for (const OverlayRow& row : overlay_table)
      if (row.layer == layer && from.request.shown.*row.shown) row.add(from, frame);
    if (layer == 1) add_bucket(from, frame);
  }
  add_outlines(from, frame);
  add_held(from, frame);
  add_grab(from, frame);
}

}  // namespace app::render
