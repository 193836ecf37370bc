#pragma once
// Up to 16 bodies of one model are solved side by side, in a block: value [particle * width + lane]. Few bodies have a
// narrower one, so that they take less memory, and one alone has a width of one. The same source serves all widths and,
// by Highway, every instruction set, and gives the same bits on each: 16 lanes are one run of 16, two of 8 or four
// of 4. Runs without a body take no time.

#include <cassert>
#include <cstddef>
#include <new>
#include <type_traits>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <glm/vec3.hpp>

namespace softbody {

inline constexpr int lanes = 16;    // of the widest block
inline constexpr int one_lane = 1;  // of a body that is alone
/// Returns the width to which a full block grows for one more body.
constexpr int next_width(int width) { return width == one_lane ? 4 : 2 * width; }
/// Calls f(constant) with a block's width, which is known only at run time.
decltype(auto) with_width(int width, const auto& f) {
  if (width == one_lane) return f(std::integral_constant<int, one_lane>());
  if (width == 4) return f(std::integral_constant<int, 4>());
  if (width == 8) return f(std::integral_constant<int, 8>());
  assert(width == lanes);
  return f(std::integral_constant<int, lanes>());
}
/// Number of bodies that implicit steps solve side by side, in double: all or a part of a block.
inline constexpr int implicit_lanes = 8;

/// Allocates memory that starts on a cache line; much of it, on a huge page, and asks the system for such pages: passes
/// over all particles would miss the table of others at each one.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) {
    void* p = ::operator new(n * sizeof(T), alignment(n));
#ifdef __linux__
    if (alignment(n) == huge_page) madvise(p, n * sizeof(T), MADV_HUGEPAGE);
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
  bool operator==(const CacheLineAllocator&) const = default;

 private:
  static constexpr std::align_val_t line{64}, huge_page{std::size_t{1} << 21};
  static std::align_val_t alignment(std::size_t n) { return n * sizeof(T) < std::size_t(huge_page) ? line : huge_page; }
};
template <class Real>
using LaneArray = std::vector<Real, CacheLineAllocator<Real>>;

/// A field of vectors: all x, then all y, then all z. Component k of particle i of lane l has the index
/// (k * particles + i) * width + l, where the width is implicit_lanes in implicit steps.
using Lanes = LaneArray<double>;

// Reads, writes or adds to the vector whose x has the index `at` = particle * width + lane.
inline glm::dvec3 read(const Lanes& field, std::size_t at) {
  const std::size_t stride = field.size() / 3;
  return {field[at], field[at + stride], field[at + 2 * stride]};
}
inline void write(Lanes& field, std::size_t at, const glm::dvec3& value) {
  const std::size_t stride = field.size() / 3;
  field[at] = value.x, field[at + stride] = value.y, field[at + 2 * stride] = value.z;
}
inline void add(Lanes& field, std::size_t at, const glm::dvec3& more) {
  const std::size_t stride = field.size() / 3;
  field[at] += more.x, field[at + stride] += more.y, field[at + 2 * stride] += more.z;
}

/// Reads one lane of a field of implicit steps by particle.
struct LaneView {
  const Lanes& field;
  std::size_t lane;
  glm::dvec3 operator()(std::size_t particle) const { return read(field, particle * implicit_lanes + lane); }
};

/// Pointers to the three components of a field over the particles of one batch.
template <class Real>
struct Field {
  Real *x, *y, *z;
  operator Field<const Real>() const requires(!std::is_const_v<Real>) { return {x, y, z}; }
  Field operator+(std::size_t values) const { return {x + values, y + values, z + values}; }
};

/// Returns the components of a field.
inline Field<double> field(Lanes& f) { return {f.data(), f.data() + f.size() / 3, f.data() + 2 * (f.size() / 3)}; }
inline Field<const double> field(const Lanes& f) {
  return {f.data(), f.data() + f.size() / 3, f.data() + 2 * (f.size() / 3)};
}

inline glm::vec3 read(Field<const float> f, std::size_t slot) { return {f.x[slot], f.y[slot], f.z[slot]}; }
inline void add(Field<float> f, std::size_t slot, const glm::vec3& more) {
  f.x[slot] += more.x, f.y[slot] += more.y, f.z[slot] += more.z;
}

/// The vectors of one body in a field, by its particles: the first one's stands at `first`, the next ones' `stride`
/// values after each other.
struct BodyField {
  Field<float> field;
  std::size_t first, stride;
  glm::dvec3 operator()(std::size_t particle) const { return glm::dvec3(read(field, first + particle * stride)); }
  void set(std::size_t particle, const glm::dvec3& value) const {
    const std::size_t at = first + particle * stride;
    field.x[at] = float(value.x), field.y[at] = float(value.y), field.z[at] = float(value.z);
  }
  void add(std::size_t particle, const glm::dvec3& more) const {
    const std::size_t at = first + particle * stride;
    field.x[at] += float(more.x), field.y[at] += float(more.y), field.z[at] += float(more.z);
  }
};

}  // namespace softbody
