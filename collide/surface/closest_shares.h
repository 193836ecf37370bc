#pragma once
// The arithmetic of closest features, from dot products to shares, without a branch: compilers turn loops over it into
// vector instructions.

namespace collide::surface {

inline constexpr float slight = 1e-6f;  // squared sine of an angle below which a face is a line, and edges are parallel

inline float share_of(float part, float whole) {
  const float t = part / whole;
  return whole > 0 ? (t < 0 ? 0.0f : t > 1 ? 1.0f : t) : 0.0f;
}

/// Of two edges p + s d1 and r + t d2.
struct EdgeShares {
  float along, across;  // s and t
  bool inner;
};
/// a = d1.d1, b = d1.d2, c = d1.(p - r), e = d2.d2, f = d2.(p - r).
inline EdgeShares edge_shares(float a, float b, float c, float e, float f) {
  const float denominator = a * e - b * b;
  const bool parallel = denominator <= slight * a * e;
  const float start = (b * f - c * e) / denominator;
  const float within = start < 0 ? 0.0f : start > 1 ? 1.0f : start;
  const float clamped = parallel ? 0.0f : within;
  const float across = share_of(b * clamped + f, e);
  const float along = share_of(b * across - c, a);
  const bool inner = !parallel & (along > 0) & (along < 1) & (across > 0) & (across < 1);
  return {along, across, inner};
}

/// Of a vertex p and a face a, b, c: the closest point's weights of b and c.
struct FaceShares {
  float v, w;
  bool inner;
  bool corner;                         // it is one
  float along_ab, along_ac, along_bc;  // the sides' points, were they the closest
};
/// ab.ap, ac.ap, ab.bp, ac.bp, ab.cp, ac.cp.
inline FaceShares face_shares(float d1, float d2, float d3, float d4, float d5, float d6) {
  const float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2, sum = va + vb + vc;
  const float ab = share_of(d1, d1 - d3), ac = share_of(d2, d2 - d6), bc = share_of(d4 - d3, (d4 - d3) + (d5 - d6));
  const bool at_a = (d1 <= 0) & (d2 <= 0), at_b = (d3 >= 0) & (d4 <= d3), at_c = (d6 >= 0) & (d5 <= d6);
  const bool on_ab = (vc <= 0) & (d1 >= 0) & (d3 <= 0), on_ac = (vb <= 0) & (d2 >= 0) & (d6 <= 0),
             on_bc = (va <= 0) & (d4 - d3 >= 0) & (d5 - d6 >= 0);
  float v = vb / sum, w = vc / sum;
  v = on_bc ? 1 - bc : v, w = on_bc ? bc : w;
  v = on_ac ? 0 : v, w = on_ac ? ac : w;
  v = on_ab ? ab : v, w = on_ab ? 0 : w;
  v = at_c ? 0 : v, w = at_c ? 1 : w;
  v = at_b ? 1 : v, w = at_b ? 0 : w;
  v = at_a ? 0 : v, w = at_a ? 0 : w;
  const bool corner = at_a | at_b | at_c;
  const bool inner = !(corner | on_ab | on_ac | on_bc);
  return {v, w, inner, corner, ab, ac, bc};
}

}  // namespace collide::surface
