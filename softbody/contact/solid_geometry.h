#pragma once
// What contact knows of each shape of a solid, but for its distance, which is in contact/solid_shapes.h: what the
// kernels see of it, and what lies inside it.

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "softbody/contact/solid.h"

namespace softbody {

// Shapes without their places, as kernels want them. Points are seen from: a sphere's or box's centre, any point of a
// plane, `from` of a capsule.
template <class Real>
struct SphereShape {
  Real radius;
};
template <class Real>
struct PlaneShape {
  glm::vec<3, Real> normal;
};
template <class Real>
struct BoxShape {
  glm::vec<3, Real> axes[3], half_size;
  Real radius;  // of the spheres that roll over its surface: edges and corners are round
};
template <class Real>
struct CapsuleShape {
  glm::vec<3, Real> segment;  // from its one end to the other
  Real radius;
};
template <class Real>
using SolidShape = std::variant<SphereShape<Real>, PlaneShape<Real>, BoxShape<Real>, CapsuleShape<Real>>;

/// What the kernels see of a solid that particles keep `thickness` m away from: its shape, grown by as much, and the
/// place that it is seen from. A plane's is the foot of `near` on it: numbers stay small near a body.
template <class Shape>
struct Placed {
  Shape shape;
  glm::dvec3 place;
};
template <class Real>
Placed<SphereShape<Real>> placed(const SolidSphere& s, double thickness, const glm::dvec3&) {
  return {{Real(s.radius + thickness)}, s.centre};
}
template <class Real>
Placed<PlaneShape<Real>> placed(const SolidPlane& p, double thickness, const glm::dvec3& near) {
  return {{glm::vec<3, Real>(p.normal)}, near + (glm::dot(p.point - near, p.normal) + thickness) * p.normal};
}
template <class Real>
Placed<BoxShape<Real>> placed(const SolidBox& b, double thickness, const glm::dvec3&) {
  using Vector = glm::vec<3, Real>;
  return {{{Vector(b.axes[0]), Vector(b.axes[1]), Vector(b.axes[2])}, Vector(b.half_size), Real(thickness)}, b.centre};
}
template <class Real>
Placed<CapsuleShape<Real>> placed(const SolidCapsule& c, double thickness, const glm::dvec3&) {
  return {{glm::vec<3, Real>(c.to - c.from), Real(c.radius + thickness)}, c.from};
}

/// A point of a solid, which meets faces of bodies between their vertices, or a line segment, which meets edges.
struct SolidCore {
  glm::dvec3 from, to;  // m, world; the same for a point
  glm::dvec3 out{0.0};  // of a box: the sum of the outward normals of its sides that meet there
  bool point() const { return from == to; }
};

/// What is deepest inside a solid: the points centre + s sides[0] + t sides[1] with s and t from -1 to 1. A rectangle,
/// or a segment or a point where sides have no length.
struct SolidMiddle {
  glm::dvec3 centre;
  std::array<glm::dvec3, 2> sides{};
  double depth;  // m, from the surface to it
};

/// What lies inside a solid. A plane has nothing: if no vertex passes it, nothing does.
struct SolidInterior {
  std::optional<SolidMiddle> middle;
  std::vector<SolidCore> cores;
  double core_radius = 0;  // m, from the cores to the surface
};
inline SolidInterior interior_of(const SolidSphere& s) {
  return {SolidMiddle{s.centre, {}, s.radius}, {{s.centre, s.centre}}, s.radius};
}
inline SolidInterior interior_of(const SolidPlane&) { return {}; }
inline SolidInterior interior_of(const SolidBox& box) {
  const double depth = std::min({box.half_size.x, box.half_size.y, box.half_size.z});
  SolidInterior in{SolidMiddle{box.centre, {}, depth}, {}};
  std::size_t side = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (box.half_size[axis] > depth && side < 2)
      in.middle->sides[side++] = (box.half_size[axis] - depth) * box.axes[axis];
  const auto out_of = [&](unsigned corner, int axis) { return (corner >> axis & 1 ? 1.0 : -1.0) * box.axes[axis]; };
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dvec3 at = box.centre, out(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      at += box.half_size[axis] * out_of(corner, axis);
      out += out_of(corner, axis);
    }
    in.cores.push_back({at, at, out});
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1) continue;
      in.cores.push_back({at, at + 2 * box.half_size[axis] * box.axes[axis], out - out_of(corner, axis)});
    }
  }
  return in;
}
inline SolidInterior interior_of(const SolidCapsule& c) {
  return {SolidMiddle{0.5 * (c.from + c.to), {0.5 * (c.to - c.from), glm::dvec3(0.0)}, c.radius},
          {{c.from, c.from}, {c.to, c.to}, {c.from, c.to}},
          c.radius};
}
inline SolidInterior interior_of(const Solid& solid) {
  return std::visit([](const auto& shape) { return interior_of(shape); }, solid.shape);
}

}  // namespace softbody
