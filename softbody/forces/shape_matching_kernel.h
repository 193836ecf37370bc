#pragma once
// Shape matching for `width` bodies at a time: the pose of the goal, and the places of the particles in it.

#include <algorithm>

#include "softbody/forces/shape_matching.h"
#include "softbody/state/kernel_bodies.h"

namespace softbody {
namespace body {

/// Computes the moments for fit_shape(), relative to one of the particles and in blocks, as in volume().
template <class Real, int width>
SB_INLINE void shape_moments(const std::vector<ShapePoint<Real>>& shape, Field<const Real> x, ShapeMoments<Real>& m) {
  using V = Lane<Real, width>;
  constexpr std::size_t block = 16;
  const Vec<V> from = load<V>(x, 0);
  Vec<V> sum{}, covariance[3]{};
  for (std::size_t first = 0; first < shape.size(); first += block) {
    Vec<V> part{}, a{}, b{}, c{};
    for (std::size_t i = first; i < std::min(first + block, shape.size()); ++i) {
      const Vec<V> d = load<V>(x, i * width) - from;
      part = part + d;
      a = a + (V{} + shape[i].x) * d;
      b = b + (V{} + shape[i].y) * d;
      c = c + (V{} + shape[i].z) * d;
    }
    sum = sum + part;
    covariance[0] = covariance[0] + a;
    covariance[1] = covariance[1] + b;
    covariance[2] = covariance[2] + c;
  }
  const V share = V{} + Real(1) / static_cast<Real>(shape.size());
  store(Field<Real>{m.mean[0], m.mean[1], m.mean[2]}, 0, from + share * sum);
  for (int k = 0; k < 3; ++k)
    store(Field<Real>{m.covariance[3 * k], m.covariance[3 * k + 1], m.covariance[3 * k + 2]}, 0, covariance[k]);
}

}  // namespace body

template <class Real, int width>
SB_INLINE void ShapeMatching::hold(const Data& data, Field<const Real> x, int used, ShapePose<Real>& pose) {
  ShapeMoments<Real> moments;
  body::shape_moments<Real, width>(data.points<Real>(), x, moments);
  fit_shape(moments, used, pose);
}

template <class At>
SB_INLINE void ShapeMatching::visit(const Data& data, const ShapePose<typename At::Real>& pose, const At& at) {
  using V = typename At::V;
  using body::load;
  const body::Vec<V> centre{load<V>(pose.centre[0]), load<V>(pose.centre[1]), load<V>(pose.centre[2])};
  body::Vec<V> column[3];
  for (int k = 0; k < 3; ++k)
    column[k] = {load<V>(pose.rotation[3 * k]), load<V>(pose.rotation[3 * k + 1]), load<V>(pose.rotation[3 * k + 2])};
  for (Index i = 0; const auto& q : data.points<typename At::Real>())
    at(Offset<V>{i++, centre + (V{} + q.x) * column[0] + (V{} + q.y) * column[1] + (V{} + q.z) * column[2]}, data);
}

}  // namespace softbody
