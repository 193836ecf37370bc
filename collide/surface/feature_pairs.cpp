#include "collide/surface/feature_pairs.h"

#include "collide/surface/closest_shares.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/surface/feature_pairs.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace collide::surface {
namespace HWY_NAMESPACE {

// Plain loops, whose bodies have no branch: the compiler makes vectors of them.

void MeetEdges(FeaturePairs& p) {
  const Index count = p.columns();
  const auto& [p0, q0, r0, s0] = p.corner_;
  for (Index i = 0; i < count; ++i) {
    const float px = p0[0][i], py = p0[1][i], pz = p0[2][i], rx = r0[0][i], ry = r0[1][i], rz = r0[2][i];
    const float x1 = q0[0][i] - px, y1 = q0[1][i] - py, z1 = q0[2][i] - pz;
    const float x2 = s0[0][i] - rx, y2 = s0[1][i] - ry, z2 = s0[2][i] - rz;
    const float x = px - rx, y = py - ry, z = pz - rz;
    const EdgeShares m = edge_shares(x1 * x1 + y1 * y1 + z1 * z1, x1 * x2 + y1 * y2 + z1 * z2, x1 * x + y1 * y + z1 * z,
                                     x2 * x2 + y2 * y2 + z2 * z2, x2 * x + y2 * y + z2 * z);
    const float ax = x + m.along * x1 - m.across * x2, ay = y + m.along * y1 - m.across * y2,
                az = z + m.along * z1 - m.across * z2;
    p.first_[i] = m.along, p.second_[i] = m.across;
    p.inner_[i] = m.inner ? 1.0f : 0.0f;
    p.apart_[0][i] = ax, p.apart_[1][i] = ay, p.apart_[2][i] = az;
    p.distance2_[i] = ax * ax + ay * ay + az * az;
  }
}

void MeetVerticesAndFaces(FeaturePairs& p) {
  const Index count = p.columns();
  const auto& [p0, a0, b0, c0] = p.corner_;
  for (Index i = 0; i < count; ++i) {
    const float px = p0[0][i], py = p0[1][i], pz = p0[2][i], ax = a0[0][i], ay = a0[1][i], az = a0[2][i];
    const float bx = b0[0][i], by = b0[1][i], bz = b0[2][i], cx = c0[0][i], cy = c0[1][i], cz = c0[2][i];
    const float abx = bx - ax, aby = by - ay, abz = bz - az, acx = cx - ax, acy = cy - ay, acz = cz - az;
    const float apx = px - ax, apy = py - ay, apz = pz - az, bpx = px - bx, bpy = py - by, bpz = pz - bz;
    const float cpx = px - cx, cpy = py - cy, cpz = pz - cz;
    const FaceShares m = face_shares(abx * apx + aby * apy + abz * apz, acx * apx + acy * apy + acz * apz,
                                     abx * bpx + aby * bpy + abz * bpz, acx * bpx + acy * bpy + acz * bpz,
                                     abx * cpx + aby * cpy + abz * cpz, acx * cpx + acy * cpy + acz * cpz);
    const float nx = aby * acz - acy * abz, ny = abz * acx - acz * abx, nz = abx * acy - acx * aby;
    const bool thin = nx * nx + ny * ny + nz * nz <=
                      slight * (abx * abx + aby * aby + abz * abz) * (acx * acx + acy * acy + acz * acz);
    const float u = 1 - m.v - m.w;
    const float dx = px - (u * ax + m.v * bx + m.w * cx), dy = py - (u * ay + m.v * by + m.w * cy),
                dz = pz - (u * az + m.v * bz + m.w * cz);
    p.first_[i] = m.v, p.second_[i] = m.w;
    p.inner_[i] = (thin & !m.corner) ? FeaturePairs::sliver : m.inner ? 1.0f : 0.0f;
    p.apart_[0][i] = dx, p.apart_[1][i] = dy, p.apart_[2][i] = dz;
    p.distance2_[i] = dx * dx + dy * dy + dz * dz;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace collide::surface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::surface {

HWY_EXPORT(MeetEdges);
HWY_EXPORT(MeetVerticesAndFaces);

void FeaturePairs::meet_edges() { HWY_DYNAMIC_DISPATCH(MeetEdges)(*this); }

void FeaturePairs::meet_vertices_and_faces() {
  HWY_DYNAMIC_DISPATCH(MeetVerticesAndFaces)(*this);
  for (Index i = 0; i < size_; ++i) {
    if (inner_[i] != sliver) continue;
    const Closest c = collide::surface::closest_vertex_face(corner(0, i), corner(1, i), corner(2, i), corner(3, i));
    first_[i] = c.weight[2], second_[i] = c.weight[3], inner_[i] = c.inner ? 1.0f : 0.0f;
    for (int axis = 0; axis < 3; ++axis) apart_[static_cast<std::size_t>(axis)][i] = c.apart[axis];
    distance2_[i] = c.apart.x * c.apart.x + c.apart.y * c.apart.y + c.apart.z * c.apart.z;
  }
}

}  // namespace collide::surface
#endif  // HWY_ONCE
