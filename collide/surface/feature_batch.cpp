#include "collide/surface/feature_batch.h"

#include "collide/surface/closest_parameters.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/surface/feature_batch.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace collide::surface {
namespace HWY_NAMESPACE {

// Plain loops without branches: the compiler vectorises them.

void FindClosestEdges(FeatureBatch& p) {
  const Index count = p.padded_size();
  const auto& [p0, q0, r0, s0] = p.corner_;
  for (Index i = 0; i < count; ++i) {
    const float px = p0[0][i], py = p0[1][i], pz = p0[2][i], rx = r0[0][i], ry = r0[1][i], rz = r0[2][i];
    const float x1 = q0[0][i] - px, y1 = q0[1][i] - py, z1 = q0[2][i] - pz;
    const float x2 = s0[0][i] - rx, y2 = s0[1][i] - ry, z2 = s0[2][i] - rz;
    const float x = px - rx, y = py - ry, z = pz - rz;
    const EdgeParameters m =
        edge_parameters(x1 * x1 + y1 * y1 + z1 * z1, x1 * x2 + y1 * y2 + z1 * z2, x1 * x + y1 * y + z1 * z,
                        x2 * x2 + y2 * y2 + z2 * z2, x2 * x + y2 * y + z2 * z);
    const float ax = x + m.s * x1 - m.t * x2, ay = y + m.s * y1 - m.t * y2, az = z + m.s * z1 - m.t * z2;
    p.first_[i] = m.s, p.second_[i] = m.t;
    p.inner_[i] = m.inner ? 1.0f : 0.0f;
    p.separation_[0][i] = ax, p.separation_[1][i] = ay, p.separation_[2][i] = az;
    p.distance2_[i] = ax * ax + ay * ay + az * az;
  }
}

void FindClosestVertexFaces(FeatureBatch& p) {
  const Index count = p.padded_size();
  const auto& [p0, a0, b0, c0] = p.corner_;
  for (Index i = 0; i < count; ++i) {
    const float px = p0[0][i], py = p0[1][i], pz = p0[2][i], ax = a0[0][i], ay = a0[1][i], az = a0[2][i];
    const float bx = b0[0][i], by = b0[1][i], bz = b0[2][i], cx = c0[0][i], cy = c0[1][i], cz = c0[2][i];
    const float abx = bx - ax, aby = by - ay, abz = bz - az, acx = cx - ax, acy = cy - ay, acz = cz - az;
    const float apx = px - ax, apy = py - ay, apz = pz - az, bpx = px - bx, bpy = py - by, bpz = pz - bz;
    const float cpx = px - cx, cpy = py - cy, cpz = pz - cz;
    const FaceCoordinates m = face_coordinates(abx * apx + aby * apy + abz * apz, acx * apx + acy * apy + acz * apz,
                                               abx * bpx + aby * bpy + abz * bpz, acx * bpx + acy * bpy + acz * bpz,
                                               abx * cpx + aby * cpy + abz * cpz, acx * cpx + acy * cpy + acz * cpz);
    const float nx = aby * acz - acy * abz, ny = abz * acx - acz * abx, nz = abx * acy - acx * aby;
    const bool thin = nx * nx + ny * ny + nz * nz <=
                      degenerate_sine2 * (abx * abx + aby * aby + abz * abz) * (acx * acx + acy * acy + acz * acz);
    const float u = 1 - m.v - m.w;
    const float dx = px - (u * ax + m.v * bx + m.w * cx), dy = py - (u * ay + m.v * by + m.w * cy),
                dz = pz - (u * az + m.v * bz + m.w * cz);
    p.first_[i] = m.v, p.second_[i] = m.w;
    p.inner_[i] = (thin & !m.corner) ? FeatureBatch::sliver : m.inner ? 1.0f : 0.0f;
    p.separation_[0][i] = dx, p.separation_[1][i] = dy, p.separation_[2][i] = dz;
    p.distance2_[i] = dx * dx + dy * dy + dz * dz;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace collide::surface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::surface {

HWY_EXPORT(FindClosestEdges);
HWY_EXPORT(FindClosestVertexFaces);

void FeatureBatch::find_closest_edges() { HWY_DYNAMIC_DISPATCH(FindClosestEdges)(*this); }

void FeatureBatch::find_closest_vertex_faces() {
  HWY_DYNAMIC_DISPATCH(FindClosestVertexFaces)(*this);
  for (Index i = 0; i < size_; ++i) {
    if (inner_[i] != sliver) continue;
    const Closest c = collide::surface::closest_vertex_face(corner(0, i), corner(1, i), corner(2, i), corner(3, i));
    first_[i] = c.weight[2], second_[i] = c.weight[3], inner_[i] = c.inner ? 1.0f : 0.0f;
    for (int axis = 0; axis < 3; ++axis) separation_[static_cast<std::size_t>(axis)][i] = c.separation[axis];
    distance2_[i] = c.separation.x * c.separation.x + c.separation.y * c.separation.y + c.separation.z * c.separation.z;
  }
}

}  // namespace collide::surface
#endif  // HWY_ONCE
