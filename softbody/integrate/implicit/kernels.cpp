#include "softbody/integrate/implicit/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "softbody/integrate/implicit/kernels.cpp"
#include <hwy/foreach_target.h>

#include "softbody/state/simd.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace {

using namespace simd;
using V = Wide<double, implicit_lanes>;

/// Solves for the unknowns of a run, once those before it are known. Two rows below it at a time keep the processor
/// busy.
void substitute_forward(const CholeskyFactor& f, const CholeskyFactor::Supernode& run, double* z) {
  const std::size_t w = run.columns;
  const double* v = f.value.data() + run.value;
  double* own = z + run.first * implicit_lanes;
  for (std::size_t j = 0; j < w; ++j, v += w) {
    V sum = load<V>(own + j * implicit_lanes);
    for (std::size_t i = 0; i < j; ++i) sum -= v[i] * load<V>(own + i * implicit_lanes);
    store(own + j * implicit_lanes, v[j] * sum);
  }
  const std::uint32_t* row = f.row.data() + run.below;
  std::size_t r = 0;
  for (; r + 1 < run.rows; r += 2, v += 2 * w) {
    double *below = z + row[r] * implicit_lanes, *next = z + row[r + 1] * implicit_lanes;
    V a = load<V>(below), b = load<V>(next);
    for (std::size_t i = 0; i < w; ++i) {
      const V known = load<V>(own + i * implicit_lanes);
      a -= v[i] * known;
      b -= v[w + i] * known;
    }
    store(below, a);
    store(next, b);
  }
  if (r == run.rows) return;
  V a = load<V>(z + row[r] * implicit_lanes);
  for (std::size_t i = 0; i < w; ++i) a -= v[i] * load<V>(own + i * implicit_lanes);
  store(z + row[r] * implicit_lanes, a);
}

/// Solves for the unknowns of a run in the transpose, once those after it are known.
void substitute_back(const CholeskyFactor& f, const CholeskyFactor::Supernode& run, double* z) {
  const std::size_t w = run.columns;
  const double *diagonal = f.value.data() + run.value, *below = diagonal + w * w;
  const std::uint32_t* row = f.row.data() + run.below;
  double* own = z + run.first * implicit_lanes;
  std::size_t j = 0;
  for (; j + 1 < w; j += 2) {
    V a = load<V>(own + j * implicit_lanes), b = load<V>(own + (j + 1) * implicit_lanes);
    for (std::size_t r = 0; r < run.rows; ++r) {
      const V known = load<V>(z + row[r] * implicit_lanes);
      a -= below[r * w + j] * known;
      b -= below[r * w + j + 1] * known;
    }
    store(own + j * implicit_lanes, a);
    store(own + (j + 1) * implicit_lanes, b);
  }
  if (j < w) {
    V a = load<V>(own + j * implicit_lanes);
    for (std::size_t r = 0; r < run.rows; ++r) a -= below[r * w + j] * load<V>(z + row[r] * implicit_lanes);
    store(own + j * implicit_lanes, a);
  }
  for (j = w; j-- > 0;) {
    V sum = load<V>(own + j * implicit_lanes);
    for (std::size_t i = j + 1; i < w; ++i) sum -= diagonal[i * w + j] * load<V>(own + i * implicit_lanes);
    store(own + j * implicit_lanes, diagonal[j * w + j] * sum);
  }
}

/// Solves L L^T x = b in place for all lanes, x = b at first; `z` is room for as much.
void substitute(const CholeskyFactor& f, double* x, double* z) {
  const std::size_t n = f.place.size();
  for (std::size_t i = 0; i < n; ++i) store(z + f.place[i] * implicit_lanes, load<V>(x + i * implicit_lanes));
  for (const CholeskyFactor::Supernode& run : f.supernodes) substitute_forward(f, run, z);
  for (std::size_t i = f.supernodes.size(); i-- > 0;) substitute_back(f, f.supernodes[i], z);
  for (std::size_t i = 0; i < n; ++i) store(x + i * implicit_lanes, load<V>(z + f.place[i] * implicit_lanes));
}

/// v = R v, or R^T v if `back`, for each particle; rotation: column c of R at 3 c.
void turn(std::size_t particles, const double (*rotation)[implicit_lanes], bool back, Field<double> v) {
  V r[3][3];  // row, column
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) (back ? r[column][row] : r[row][column]) = load<V>(rotation[3 * column + row]);
  for (std::size_t at = 0; at < particles * implicit_lanes; at += implicit_lanes) {
    const Vec<V> a = load<V>(v, at);
    store(v, at,
          Vec<V>{r[0][0] * a.x + r[0][1] * a.y + r[0][2] * a.z, r[1][0] * a.x + r[1][1] * a.y + r[1][2] * a.z,
                 r[2][0] * a.x + r[2][1] * a.y + r[2][2] * a.z});
  }
}

/// Writes the inner product in each lane.
void inner_product(std::size_t count, const double* a, const double* b, double* result) {
  V sum{};
  for (std::size_t at = 0; at < count * implicit_lanes; at += implicit_lanes) sum += load<V>(a + at) * load<V>(b + at);
  store(result, sum);
}

/// Adds a, times the factor of each lane, to y.
void add_scaled(std::size_t count, const double* times, const double* a, double* y) {
  const V t = load<V>(times);
  for (std::size_t at = 0; at < count * implicit_lanes; at += implicit_lanes)
    store(y + at, load<V>(y + at) + t * load<V>(a + at));
}

constexpr ImplicitKernels table{substitute, turn, inner_product, add_scaled};

const ImplicitKernels& Table() { return table; }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(Table);

const ImplicitKernels& implicit_kernels() { return HWY_DYNAMIC_DISPATCH(Table)(); }

}  // namespace softbody
#endif  // HWY_ONCE
