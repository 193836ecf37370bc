#include "tests/stages/floor.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/stages/floor.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stages {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;  // as wide as the kernels of bodies
constexpr Tag tag;

/// x += h v, for a multiple of 64 numbers.
void Stream(float* x, const float* v, std::size_t count) {
  const auto h = hn::Set(tag, 1e-3f);
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag))
    hn::Store(hn::Add(hn::Load(tag, x + i), hn::Mul(h, hn::Load(tag, v + i))), tag, x + i);
}

/// Returns how many roots and as many quotients a round takes. Eight chains hide how long each takes to come out.
std::size_t RootsAndQuotients(std::size_t rounds, float* out) {
  auto a = hn::Set(tag, 1.5f), b = a, c = a, d = a, e = a, f = a, g = a, k = a;
  for (std::size_t i = 0; i < rounds; ++i)
    for (auto* one : {&a, &b, &c, &d, &e, &f, &g, &k}) *one = hn::Div(hn::Set(tag, 2.0f), hn::Sqrt(*one));
  const auto sum = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)), hn::Add(hn::Add(e, f), hn::Add(g, k)));
  hn::StoreU(sum, tag, out);
  return 8 * hn::Lanes(tag);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace stages
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>

#include "app/base/timings.h"
#include "softbody/state/lanes.h"

namespace stages {

HWY_EXPORT(Stream);
HWY_EXPORT(RootsAndQuotients);

namespace {

/// Returns the median (ms) of a few runs, of which the first only warms up.
double median_ms(const auto& run) {
  app::Timings timings;
  run();
  for (int i = 0; i < 9; ++i) timings.ms.push_back(app::time_ms(run));
  return timings.median();
}

}  // namespace

double stream_ns(std::size_t bytes) {
  const std::size_t count = (bytes / (2 * sizeof(float)) + 63) / 64 * 64;
  const std::size_t passes = std::max<std::size_t>(1, (std::size_t{1} << 24) / count);
  softbody::LaneArray<float> x(count, 1.0f), v(count, 1.0f);
  const double ms = median_ms([&] {
    for (std::size_t i = 0; i < passes; ++i) HWY_DYNAMIC_DISPATCH(Stream)(x.data(), v.data(), count);
  });
  return 1e6 * ms / double(passes) / double(3 * sizeof(float) * count);
}

double root_and_quotient_ns(collide::Workers& workers) {
  constexpr std::size_t rounds = 1'000'000;
  std::size_t in_round = 0;
  const double ms = app::time_ms([&] {
    workers.run_together(workers.threads(), [&](int thread) {
      float sink[16];
      const std::size_t n = HWY_DYNAMIC_DISPATCH(RootsAndQuotients)(rounds, sink);
      if (thread == 0) in_round = n;
    });
  });
  return 1e6 * ms / double(rounds * in_round) / workers.threads();
}

}  // namespace stages
#endif  // HWY_ONCE
