#pragma once
// The arithmetic of closest points, from dot products to parameters along edges and barycentric coordinates. It has no
// branches, so that compilers vectorise loops over it.

namespace collide::surface {

/// Squared sine of an angle. At or below it, a face counts as degenerate, and two edges count as parallel.
inline constexpr float degenerate_sine2 = 1e-6f;

/// Returns part / whole, clamped to 0 .. 1; 0 if whole is not positive.
inline float clamped_ratio(float part, float whole) {
  const float t = part / whole;
  return whole > 0 ? (t < 0 ? 0.0f : t > 1 ? 1.0f : t) : 0.0f;
}

/// The parameters of the closest points p + s d1 and r + t d2 of two edges.
struct EdgeParameters {
  float s, t;
  bool inner;  // both points lie inside their edges, and the edges are not parallel
};
/// Returns the parameters from a = d1.d1, b = d1.d2, c = d1.(p - r), e = d2.d2 and f = d2.(p - r).
inline EdgeParameters edge_parameters(float a, float b, float c, float e, float f) {
  const float denominator = a * e - b * b;
  const bool parallel = denominator <= degenerate_sine2 * a * e;
  const float of_lines = (b * f - c * e) / denominator;
  const float clamped = of_lines < 0 ? 0.0f : of_lines > 1 ? 1.0f : of_lines;
  const float start = parallel ? 0.0f : clamped;
  const float t = clamped_ratio(b * start + f, e);
  const float s = clamped_ratio(b * t - c, a);
  const bool inner = !parallel & (s > 0) & (s < 1) & (t > 0) & (t < 1);
  return {s, t, inner};
}

/// The barycentric coordinates of the point of a face abc that is closest to a vertex p.
struct FaceCoordinates {
  float v, w;                          // the weights of b and c
  bool inner;                          // the point lies inside the face
  bool corner;                         // the point is a corner
  float along_ab, along_ac, along_bc;  // the parameters of the closest points of the sides
};
/// Returns the coordinates from d1 = ab.ap, d2 = ac.ap, d3 = ab.bp, d4 = ac.bp, d5 = ab.cp and d6 = ac.cp.
inline FaceCoordinates face_coordinates(float d1, float d2, float d3, float d4, float d5, float d6) {
  const float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2, sum = va + vb + vc;
  const float ab = clamped_ratio(d1, d1 - d3), ac = clamped_ratio(d2, d2 - d6),
              bc = clamped_ratio(d4 - d3, (d4 - d3) + (d5 - d6));
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
