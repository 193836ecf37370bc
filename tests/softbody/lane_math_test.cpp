// Arithmetic in lanes and the law of contact in them, on each of Highway's targets: to the bit that of plain floats.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "tests/every_target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/softbody/lane_math_test.cpp"
#include <hwy/foreach_target.h>

#include "softbody/contact/law.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::test {
namespace HWY_NAMESPACE {
namespace {

using namespace softbody::HWY_NAMESPACE;

/// Hands all that comes of a and b to add().
template <class V, class Add>
HWY_INLINE void compute(V a, V b, const Add& add) {
  using namespace simd;
  const V step(0.003f), zero{};
  add(a + b), add(a - b), add(a * b), add(a / b), add(-a), add(2.0f - a), add(square_root(a));
  add(larger(a, b)), add(smaller(a, b)), add(select(a > b, a, b)), add(select(a < b, a, b)), add(select(a >= b, a, b));
  V sum = a;
  sum += b, sum -= step;
  add(sum);
  const V finite = select(zero * a >= zero, a, zero);
  if constexpr (lanes_of<V> <= register_lanes<double>)
    add(narrowed(widened(finite)));
  else
    add(finite);
  add(law::min_move(a, 0.003f)), add(law::min_speed(a, 300.0f)), add(law::bounce_energy(a, b, step, 0.7f));
  const Vec<V> held = law::within_cone(Vec<V>{a, b, step}, larger(b, zero));
  add(held.x), add(held.y), add(held.z);
}

/// What it is for the values of a and b in all lanes, and in which of these a > b.
template <class V>
std::vector<float> results(const float* a, const float* b, unsigned& above) {
  std::vector<float> all;
  above = 0;
  for (int first = 0; first < lanes; first += simd::lanes_of<V>) {
    const V x = simd::load<V>(a + first), y = simd::load<V>(b + first);
    above |= simd::lanes_above(x, y) << first;
    EXPECT_EQ(simd::any_above(x, y), simd::lanes_above(x, y) != 0);
    std::size_t at = std::size_t(first);
    compute(x, y, [&](V value) HWY_ATTR {
      if (all.size() < at + simd::lanes_of<V>) all.resize(at + std::size_t(lanes));
      simd::store(all.data() + at, value);
      at += std::size_t(lanes);
    });
  }
  return all;
}

template <class V>
void compare_with_floats(const float* a, const float* b) {
  unsigned above, above_each;
  const std::vector<float> in_lanes = results<V>(a, b, above), each = results<float>(a, b, above_each);
  EXPECT_EQ(above, above_each);
  ASSERT_EQ(in_lanes.size(), each.size());
  for (std::size_t i = 0; i < each.size(); ++i)
    EXPECT_TRUE(std::isnan(each[i]) ? std::isnan(in_lanes[i]) : std::memcmp(&in_lanes[i], &each[i], sizeof(float)) == 0)
        << "result " << i / std::size_t(lanes) << ": " << in_lanes[i] << " and " << each[i];
}

void CompareWithFloats(const float* a, const float* b) {
  compare_with_floats<simd::Run<float, lanes>>(a, b);
  compare_with_floats<simd::Run<float, lanes, simd::register_lanes<double>>>(a, b);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody::test
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody::test {
namespace {

HWY_EXPORT(CompareWithFloats);

class LaneMath : public tests::OnEveryTarget {};

TEST_P(LaneMath, GivesTheBitsOfPlainFloats) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> values{0.0f,   -0.0f, 1.0f, -1.0f, 0.002f,   -0.004f,   0.3f, -0.7f,
                                  1e-30f, 1e30f, nan,  0.5f,  infinity, -infinity, 2.5f, -0.0003f};
  for (std::size_t shift = 0; shift < values.size(); ++shift) {
    std::array<float, lanes> a, b;
    for (std::size_t l = 0; l < a.size(); ++l)
      a[l] = values[l % values.size()], b[l] = values[(3 * l + shift) % values.size()];
    HWY_DYNAMIC_DISPATCH(CompareWithFloats)(a.data(), b.data());
  }
}

INSTANTIATE_TEST_SUITE_P(All, LaneMath, testing::ValuesIn(tests::targets()), tests::target_name);

}  // namespace
}  // namespace softbody::test
#endif  // HWY_ONCE
