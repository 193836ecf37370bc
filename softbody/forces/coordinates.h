#pragma once
// Coordinates: numbers that the places of a body's particles give. A force is a law of one of them. It says for which
// particles (visit()) and how strongly its law pulls (pull(), which works against the growth of the coordinate); how
// that acts on the particles, in lanes and in double, in every integrator, in the matrix and in the stability bound, is
// written once for each coordinate (kernel_bodies.h, bound.cpp, implicit/matrix.cpp).

#include "softbody/mesh/mesh.h"
#include "softbody/state/lane_math.h"

namespace softbody {

/// The distance between two particles. Its law has `stiffness` (N/m, the largest slope of pull()), `damping` (N s/m),
/// pull(length) in N and stored(length) in J.
struct Length {
  Index i, j;
};

/// The volume inside the mesh. Its law has pull(volume) in Pa, stored(volume) and stored_change(from, to) in J, and
/// scale() in Pa, about the largest of its pressures.
struct Volume {};

/// The way of particle i from a place. Its law has `stiffness` (N/m).
template <class V>
struct Offset {
  Index i;
  body::Vec<V> place;
};

/// The way of particle i through space. Its law has `damping` (N s/m) and no other force.
struct Path {
  Index i;
};

enum class Coordinate { length, volume, offset, path };

/// A number and its derivative: the pull of a law at Jet{q, 1} has the law's stiffness as its slope.
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

/// Returns how fast the pull of a law grows with its coordinate q.
double stiffness_at(const auto& law, double q) { return law.pull(Jet(q, 1)).slope; }

}  // namespace softbody
