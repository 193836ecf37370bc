#pragma once
// Coordinates: numbers that the places of a body's particles give. A force is a law of one of them. It says which
// elements it has and how strongly its law pulls (a pull works against the growth of the coordinate). How that acts on
// the particles, in lanes and in double, in every integrator, in the matrix and in the stability bound, is written once
// for each coordinate (kernel_bodies.h, bound.cpp, deformation.cpp, implicit/matrix.cpp).

#include <type_traits>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

enum class Coordinate {
  /// The distance between two particles. The data have elements<Real>(): a list of laws with the particles i < j in
  /// ascending order, `stiffness` (N/m, the largest slope of the pull) and `damping` (N s/m). The functions
  /// pull_at(law, length) in N and stored_at(law, length) in J take lanes, too, so they stand in a header that is
  /// compiled for each of Highway's targets and that kernel_bodies.h includes, as spring_law.h.
  length,
  /// The volume inside the mesh. The data are a law that has pull(volume) in Pa, stored(volume) and
  /// stored_change(from, to) in J, and scale() in Pa, about the largest of its pressures.
  volume,
  /// The way of each particle from its place in a shape, which follows the body. The data have elements<Real>(), the
  /// shape, and `stiffness` (N/m).
  offset,
  /// The way of each particle through space. The data have `damping` (N s/m), the same at any speed, and there is no
  /// other force.
  path,
};

// Elements, as visitors see them.
struct Length {
  Index i, j;
};
struct Volume {};
struct Offset {
  Index i;
};
struct Path {
  Index i;
};

/// A list of elements that a force keeps in double and, rounded, in float.
template <template <class> class Element>
struct ElementList {
  std::vector<Element<double>> exact;
  std::vector<Element<float>> rounded;

  void add(const Element<double>& e) {
    exact.push_back(e);
    rounded.push_back(e.rounded());
  }
  template <class Real>
  const std::vector<Element<Real>>& elements() const {
    if constexpr (std::is_same_v<Real, float>)
      return rounded;
    else
      return exact;
  }
};

/// A number and its derivative: the pull of a law at Jet(q, 1) has the law's stiffness as its slope.
struct Jet {
  double value, slope = 0;

  Jet(double v, double s = 0) : value(v), slope(s) {}
  friend Jet operator-(Jet a) { return {-a.value, -a.slope}; }
  friend Jet operator+(Jet a, Jet b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Jet operator-(Jet a, Jet b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Jet operator*(Jet a, Jet b) { return {a.value * b.value, a.slope * b.value + a.value * b.slope}; }
  friend Jet operator/(Jet a, Jet b) {
    return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
  }
  friend bool operator<(Jet a, Jet b) { return a.value < b.value; }
  friend bool operator>(Jet a, Jet b) { return a.value > b.value; }
  friend bool operator>=(Jet a, Jet b) { return a.value >= b.value; }
};

}  // namespace softbody
