#include "softbody/mesh/surface.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "collide/core/workers.h"
#include "collide/oracle/surface_oracle.h"
#include "softbody/mesh/points.h"

namespace softbody {
namespace {

constexpr Index none = ~Index{0};

struct Neighbour {
  Index face = none;  // none: a side is at the border
  bool agrees = true;
  Edge edge{};
};

using Neighbours = std::vector<std::array<Neighbour, 3>>;  // of each face

/// Throws SurfaceError if an edge has more than two faces.
Neighbours neighbours_of(const std::vector<Triangle>& triangles) {
  Index vertices = 0;
  for (const Triangle& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  const collide::surface::Surface surface(vertices, triangles);
  Neighbours neighbours(triangles.size());
  std::vector<std::size_t> used(triangles.size(), 0);
  const auto add = [&](Index face, const Neighbour& n) { neighbours[face][used[face]++] = n; };
  const auto runs_along = [&](Index face, const Edge& edge) {  // from edge[0] to edge[1]
    const Triangle& t = triangles[face];
    const auto from = std::size_t(std::ranges::find(t, edge[0]) - t.begin());
    return t[(from + 1) % 3] == edge[1];
  };
  for (const Edge& edge : surface.edges()) {
    std::vector<Index> there;
    std::ranges::copy_if(surface.triangles_at(edge[0]), std::back_inserter(there),
                         [&](Index f) { return std::ranges::count(triangles[f], edge[1]) > 0; });
    if (there.size() > 2) throw SurfaceError("has more than two faces", edge, std::move(there));
    const bool agree = runs_along(there.front(), edge) != runs_along(there.back(), edge);
    if (there.size() == 2) add(there[0], {there[1], agree, edge}), add(there[1], {there[0], agree, edge});
  }
  return neighbours;
}

enum class Turned : char { no, yes, unseen };

/// Returns the part of a face, and marks the faces that must be reversed to agree with it. Throws SurfaceError if the
/// part has one side only.
SurfacePart part_of_face(Index start, const Neighbours& neighbours, std::vector<Turned>& turned) {
  SurfacePart part{{start}, true};
  turned[start] = Turned::no;
  for (std::size_t i = 0; i < part.faces.size(); ++i) {
    const Index face = part.faces[i];
    for (const Neighbour& n : neighbours[face]) {
      part.closed = part.closed && n.face != none;
      if (n.face == none) continue;
      const Turned wanted = n.agrees == (turned[face] == Turned::no) ? Turned::no : Turned::yes;
      if (turned[n.face] == Turned::unseen) {
        turned[n.face] = wanted;
        part.faces.push_back(n.face);
      } else if (turned[n.face] != wanted) {
        throw SurfaceError("has only one side", n.edge, {face, n.face});
      }
    }
  }
  return part;
}

/// Returns for each of these closed parts how many others it lies wholly inside; none for one that meets another.
std::vector<std::size_t> depths_of(const std::vector<SurfacePart>& parts, const std::vector<Triangle>& triangles,
                                   const std::vector<glm::dvec3>& vertices) {
  Points at;
  collide::Bodies bodies;
  collide::surface::Surfaces surfaces;
  std::vector<Index> owner;  // of each vertex of the bodies
  for (const SurfacePart& part : parts) {
    std::vector<Triangle> faces;
    for (const Index f : part.faces) faces.push_back(triangles[f]);
    std::vector<glm::dvec3> points;
    for (const Index v : renumber_vertices(faces)) points.push_back(vertices[v]);
    at.add(points);
    owner.resize(owner.size() + points.size(), static_cast<Index>(surfaces.size()));
    const auto count = static_cast<Index>(points.size());
    surfaces.push_back(std::make_shared<const collide::surface::Surface>(count, std::move(faces)));
    bodies.add(std::make_shared<collide::Shape>(count, surfaces.back()->edges()));
  }
  collide::Workers workers(1);
  const auto overlaps = collide::oracle::find_overlaps({at.x, at.y, at.z, &bodies}, surfaces, workers, false);
  std::map<std::pair<Index, Index>, std::size_t> inside;  // vertices of a part inside another
  for (const auto& p : overlaps.penetrations) ++inside[{owner[p.vertex], p.body}];
  std::vector<std::size_t> depth(parts.size(), 0);
  std::vector<char> meets(parts.size(), false);
  for (const auto& [pair, count] : inside) {
    ++depth[pair.first];
    if (count < bodies.size(pair.first)) meets[pair.first] = meets[pair.second] = true;
  }
  for (const auto& p : overlaps.piercings)
    if (p.edge_body != p.triangle_body) meets[p.edge_body] = meets[p.triangle_body] = true;
  for (Index i = 0; i < parts.size(); ++i)
    if (meets[i]) depth[i] = 0;
  return depth;
}

}  // namespace

std::vector<SurfacePart> align(std::vector<Triangle>& triangles) {
  const Neighbours neighbours = neighbours_of(triangles);
  std::vector<Turned> turned(triangles.size(), Turned::unseen);
  std::vector<SurfacePart> parts;
  for (Index start = 0; start < triangles.size(); ++start) {
    if (turned[start] != Turned::unseen) continue;
    const SurfacePart& part = parts.emplace_back(part_of_face(start, neighbours, turned));
    const auto marked = std::ranges::count_if(part.faces, [&](Index f) { return turned[f] == Turned::yes; });
    const Turned wrong = part.closed && 2 * marked > std::ssize(part.faces) ? Turned::no : Turned::yes;
    for (const Index f : part.faces)
      if (turned[f] == wrong) std::swap(triangles[f][1], triangles[f][2]);
  }
  return parts;
}

double volume(const std::vector<glm::dvec3>& vertices, const std::vector<Triangle>& triangles,
              const SurfacePart& part) {
  std::vector<Triangle> faces;
  for (const Index f : part.faces) faces.push_back(triangles[f]);
  return volume(vertices, faces);
}

SurfaceFindings orient(std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& vertices) {
  const std::vector<Triangle> before = triangles;
  std::vector<SurfacePart> parts = align(triangles);
  SurfaceFindings findings{.components = parts.size()};
  findings.closed = std::erase_if(parts, [](const SurfacePart& part) { return !part.closed; }) == 0;
  std::vector<char> inwards;
  for (const SurfacePart& part : parts) inwards.push_back(volume(vertices, triangles, part) < 0);
  const bool may_have_cavities = parts.size() > 1 && std::ranges::count(inwards, char(true)) > 0;
  const std::vector<std::size_t> depth =
      may_have_cavities ? depths_of(parts, triangles, vertices) : std::vector<std::size_t>(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!inwards[i]) continue;
    if (depth[i] % 2 == 1)
      ++findings.cavities;
    else
      for (const Index f : parts[i].faces) std::swap(triangles[f][1], triangles[f][2]);
  }
  for (std::size_t f = 0; f < before.size(); ++f) findings.turned_faces += triangles[f] != before[f];
  return findings;
}

}  // namespace softbody
