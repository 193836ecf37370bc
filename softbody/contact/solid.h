#pragma once
// Solids that bodies meet, as a scene has them. They do not move. What contact knows of a shape stands in
// contact/solid_geometry.h and contact/solid_shapes.h.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "softbody/model/key.h"

namespace softbody {

/// What all solids of a shape have in common.
struct ShapeTraits {
  std::string_view key;     // of their tables in a scene file
  std::string_view name;    // for the user
  double friction = 0.5;    // where the scene file does not say it
  bool half_space = false;  // without edges, corners, and an end to hold it by
  bool single = false;      // a scene has at most one, in the table [key]; others are in [[key]]
};

// Kinds of the values of a shape. Its function values(visit) calls visit(key, kind{value}) for each of them. The reader
// and the writer of scene files, the panel and the mouse know the kinds, not the shapes.
namespace solid {
template <class OfKind, class T>
struct Value {
  using Kind = OfKind;
  T& value;
};
struct PlaceKind {
  static constexpr Key::Limits limits{-1e6, 1e6};
};
struct HeightKind : PlaceKind {};
struct LengthKind {
  static constexpr Key::Limits limits{1e-9, 1e6};
};
struct SizeKind {
  static constexpr Key::Limits limits{LengthKind::limits.least / 2, LengthKind::limits.most / 2};
};
using Place = Value<PlaceKind, glm::dvec3>;    // m; a solid is moved by moving all its places
using Length = Value<LengthKind, double>;      // m
using Height = Value<HeightKind, double>;      // m
using HalfSize = Value<SizeKind, glm::dvec3>;  // m, along the solid's axes; a scene file has the whole size
using Direction = Value<struct DirectionKind, glm::dvec3>;  // unit
using Axes = Value<struct AxesKind, glm::dmat3>;            // orthonormal columns

inline bool is_valid(const glm::dvec3& direction) { return std::abs(glm::dot(direction, direction) - 1) < 1e-9; }
inline bool is_valid(const glm::dmat3& axes) {
  const glm::dmat3 error = glm::transpose(axes) * axes - glm::dmat3(1.0);
  const double most = std::max({glm::length(error[0]), glm::length(error[1]), glm::length(error[2])});
  return most <= 1e-9 && glm::determinant(axes) > 0;
}
}  // namespace solid

struct SolidSphere {
  static constexpr ShapeTraits traits{.key = "solid_sphere", .name = "Sphere"};
  glm::dvec3 centre{0.0};  // m
  double radius = 1;       // m
  void values(auto&& visit) { visit("centre", solid::Place{centre}), visit("radius", solid::Length{radius}); }
  bool operator==(const SolidSphere&) const = default;
};

/// Everything below an unbounded plane.
struct SolidPlane {
  static constexpr ShapeTraits traits{.key = "solid_plane", .name = "Plane", .half_space = true};
  glm::dvec3 point{0.0};       // m, anywhere on it
  glm::dvec3 normal{0, 1, 0};  // unit, out of the solid
  void values(auto&& visit) { visit("point", solid::Place{point}), visit("normal", solid::Direction{normal}); }
  bool operator==(const SolidPlane&) const = default;
};

/// The plane y = height. Contact and pictures take it as a SolidPlane.
struct Ground {
  static constexpr ShapeTraits traits{
      .key = "ground", .name = "Ground", .friction = 0.6, .half_space = true, .single = true};
  double height = 0;  // m
  void values(auto&& visit) { visit("height", solid::Height{height}); }
  operator SolidPlane() const { return {{0, height, 0}, {0, 1, 0}}; }
  bool operator==(const Ground&) const = default;
};

struct SolidBox {
  static constexpr ShapeTraits traits{.key = "solid_box", .name = "Box"};
  glm::dvec3 centre{0.0};     // m
  glm::dvec3 half_size{0.5};  // m, along its own axes
  glm::dmat3 axes{1.0};       // columns: those axes in the world, orthonormal
  void values(auto&& visit) {
    visit("centre", solid::Place{centre}), visit("size", solid::HalfSize{half_size});
    visit("rotation", solid::Axes{axes});
  }
  bool operator==(const SolidBox&) const = default;
};

/// All points within a radius of a line segment.
struct SolidCapsule {
  static constexpr ShapeTraits traits{.key = "solid_capsule", .name = "Capsule"};
  glm::dvec3 from{-0.5, 0, 0}, to{0.5, 0, 0};  // m, ends of the segment
  double radius = 0.25;                        // m
  void values(auto&& visit) {
    visit("from", solid::Place{from}), visit("to", solid::Place{to}), visit("radius", solid::Length{radius});
  }
  bool operator==(const SolidCapsule&) const = default;
};

struct Solid {
  /// In the order in which the reader of scene files lists solids and a step handles them.
  using Shape = std::variant<SolidSphere, Ground, SolidPlane, SolidBox, SolidCapsule>;

  static constexpr Key::Limits friction_limits{0, 10}, restitution_limits{0, 1};

  Shape shape;
  double friction = traits().friction;  // Coulomb's coefficient
  double restitution = 0;               // 0 to 1, see contact/rebound.h
  bool enabled = true;                  // bodies pass through a solid that is not

  const ShapeTraits& traits() const {
    return std::visit([](const auto& one) -> const ShapeTraits& { return one.traits; }, shape);
  }
  void values(auto&& visit) {
    std::visit([&](auto& one) { one.values(visit); }, shape);
  }
  bool operator==(const Solid&) const = default;
};

}  // namespace softbody
