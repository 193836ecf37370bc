#include "tests/bench/patches.h"

#include <cstring>
#include <limits>
#include <numeric>

namespace bench {
namespace {

using collide::Index;

template <Index Width>
struct LanesOf {
  typedef float Type __attribute__((vector_size(Width * sizeof(float))));
};

/// If a comparison held in any lane.
template <class Mask>
bool any(const Mask& mask) {
  std::array<std::uint64_t, sizeof(Mask) / sizeof(std::uint64_t)> parts;
  std::memcpy(parts.data(), &mask, sizeof mask);
  std::uint64_t all = 0;
  for (const std::uint64_t part : parts) all |= part;
  return all != 0;
}

std::span<const float> longest_axis(const collide::Frame& frame, std::span<const Index> vertices) {
  std::span<const float> longest;
  float length = -1;
  for (const auto axis : {frame.x, frame.y, frame.z}) {
    const auto less = [&](Index a, Index b) { return axis[a] < axis[b]; };
    const auto [lo, hi] = std::minmax_element(vertices.begin(), vertices.end(), less);
    if (axis[*hi] - axis[*lo] > length) length = axis[*hi] - axis[*lo], longest = axis;
  }
  return longest;
}

}  // namespace

template <Index Width>
void Patches<Width>::update(const collide::Frame& frame, float tolerance) {
  if (first_ != frame.bodies->first) {
    first_ = frame.bodies->first;
    slots_.clear();
    std::vector<Index> vertices(frame.x.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    for (Index b = 0; b + 1 < first_.size(); ++b)
      cut(frame, b, std::span(vertices).subspan(first_[b], first_[b + 1] - first_[b]));
    boxes_.resize(slots_.size());
  }
  const float pad = half_of(tolerance);
  const std::array source{frame.x, frame.y, frame.z};
  for (std::size_t p = 0; p < slots_.size(); ++p) {
    Slots& s = slots_[p];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& values = s.position[axis];
      for (Index k = 0; k < s.size; ++k) values[k] = source[axis][s.vertex[k]];
      const auto [lo, hi] = std::minmax_element(values.begin(), values.begin() + s.size);
      boxes_[p].lo[axis] = *lo - pad;
      boxes_[p].hi[axis] = *hi + pad;
    }
  }
}

/// In the middle of the longest side, until a patch is small enough.
template <Index Width>
void Patches<Width>::cut(const collide::Frame& frame, Index body, std::span<Index> vertices) {
  if (vertices.empty()) return;
  if (vertices.size() <= Width) return add(body, vertices);
  const std::size_t middle = (vertices.size() / 2 + Width - 1) / Width * Width;  // so that few lanes stay empty
  std::nth_element(vertices.begin(), vertices.begin() + std::ptrdiff_t(middle), vertices.end(),
                   [axis = longest_axis(frame, vertices)](Index a, Index b) { return axis[a] < axis[b]; });
  cut(frame, body, vertices.first(middle));
  cut(frame, body, vertices.subspan(middle));
}

template <Index Width>
void Patches<Width>::add(Index body, std::span<const Index> vertices) {
  Slots& s = slots_.emplace_back();
  for (auto& values : s.position) values.fill(std::numeric_limits<float>::quiet_NaN());
  std::copy(vertices.begin(), vertices.end(), s.vertex.begin());
  s.size = static_cast<Index>(vertices.size());
  s.body = body;
}

template <Index Width>
void Patches<Width>::test(Index p, Index q, const ContactFilter& filter,
                          std::vector<collide::Contact>& contacts) const {
  using Lanes = typename LanesOf<Width>::Type;
  const Slots &s = slots_[p], &t = slots_[q];
  std::array<Lanes, 3> other;
  for (std::size_t axis = 0; axis < 3; ++axis) std::memcpy(&other[axis], t.position[axis].data(), sizeof(Lanes));
  for (Index i = 0; i < s.size; ++i) {
    const Lanes dx = s.position[0][i] - other[0], dy = s.position[1][i] - other[1], dz = s.position[2][i] - other[2];
    const auto near = dx * dx + dy * dy + dz * dz < filter.tolerance2();
    if (!any(near)) continue;
    for (Index k = p == q ? i + 1 : 0; k < t.size; ++k) {
      const Index a = s.vertex[i], b = t.vertex[k];
      if (near[k] && filter.allowed(a, b)) contacts.push_back({std::min(a, b), std::max(a, b)});
    }
  }
}

template <Index Width>
void Patches<Width>::test_insides(const ContactFilter& filter, std::vector<collide::Contact>& contacts) const {
  for (Index p = 0; p < count(); ++p) test(p, p, filter, contacts);
}

template class Patches<8>;
template class Patches<16>;

}  // namespace bench
