#include "softbody/mesh/surface.h"

#include <algorithm>
#include <utility>

namespace softbody {
namespace {

constexpr Index none = ~Index{0};

/// A side of a triangle.
struct Side {
  Edge edge;
  Index face;
  bool ascends;  // the triangle runs along it from edge[0] to edge[1]
  auto operator<=>(const Side&) const = default;
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  for (Index f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangles[f][k], b = triangles[f][(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, f, a < b});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

struct Neighbour {
  Index face = none;  // none: the side is at the border
  bool agrees = true;
  Edge edge{};
};

/// Walks over the components and decides for each face whether it must be reversed.
class Orientation {
 public:
  Orientation(std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& vertices)
      : triangles_(triangles), vertices_(vertices), neighbours_(triangles.size()), turned_(triangles.size(), unseen) {
    join(sorted_sides(triangles));
  }

  SurfaceFindings run() {
    for (Index f = 0; f < triangles_.size(); ++f) {
      if (turned_[f] != unseen) continue;
      ++findings_.components;
      settle(walk(f));
    }
    return findings_;
  }

 private:
  enum Turned : char { no, yes, unseen };

  void join(const std::vector<Side>& sides) {
    std::vector<std::size_t> used(triangles_.size(), 0);
    const auto add = [&](Index face, const Neighbour& n) { neighbours_[face][used[face]++] = n; };
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
      if (end - i > 2) {
        std::vector<Index> there;
        for (; i < end; ++i) there.push_back(sides[i].face);
        throw SurfaceError("has more than two faces", sides[end - 1].edge, std::move(there));
      }
      const Side &a = sides[i], &b = sides[end - 1];
      if (end - i == 1) {
        add(a.face, {});
        ++findings_.border_edges;
      } else {
        add(a.face, {b.face, a.ascends != b.ascends, a.edge});
        add(b.face, {a.face, a.ascends != b.ascends, a.edge});
      }
      i = end;
    }
  }

  /// Returns the component of a face, and marks the faces that must be reversed to agree with it.
  std::vector<Index> walk(Index start) {
    std::vector<Index> component{start};
    turned_[start] = no;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const Index face = component[i];
      for (const Neighbour& n : neighbours_[face]) {
        if (n.face == none) continue;
        const Turned wanted = n.agrees == (turned_[face] == no) ? no : yes;
        if (turned_[n.face] == unseen) {
          turned_[n.face] = wanted;
          component.push_back(n.face);
        } else if (turned_[n.face] != wanted) {
          throw SurfaceError("has only one side", n.edge, {face, n.face});
        }
      }
    }
    return component;
  }

  /// Reverses the marked faces, or the others if the closed component would be inside out.
  void settle(const std::vector<Index>& component) {
    bool closed = true;
    std::vector<Triangle> faces;
    for (const Index f : component) {
      Triangle t = triangles_[f];
      if (turned_[f] == yes) std::swap(t[1], t[2]);
      faces.push_back(t);
      for (const Neighbour& n : neighbours_[f]) closed = closed && n.face != none;
    }
    const bool inside_out = closed && volume(vertices_, faces) < 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      Triangle& t = triangles_[component[i]];
      if (inside_out) std::swap(faces[i][1], faces[i][2]);
      if (t == faces[i]) continue;
      t = faces[i];
      ++findings_.turned_faces;
    }
  }

  std::vector<Triangle>& triangles_;
  const std::vector<glm::dvec3>& vertices_;
  std::vector<std::array<Neighbour, 3>> neighbours_;  // of each face
  std::vector<Turned> turned_;
  SurfaceFindings findings_;
};

}  // namespace

SurfaceFindings orient(std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& vertices) {
  return Orientation(triangles, vertices).run();
}

}  // namespace softbody
