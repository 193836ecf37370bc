#include "collide/vertex_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

// Highway compiles this file once for each of its targets. The first two of these were seen to gain nothing here; the
// others have vectors of no fixed size, but blocks here are of a fixed number of lanes.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/vertex_kernels.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace collide {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Index lanes = static_cast<Index>(hn::MaxLanes(Floats()));
static_assert(lanes <= Picked::padding && 64 % lanes == 0);

HWY_INLINE V load(const float* at) { return hn::LoadU(Floats(), at); }
HWY_INLINE V all(float value) { return hn::Set(Floats(), value); }

HWY_INLINE std::uint64_t bits_of(M mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(Floats(), mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

/// Calls block(first, skip) for blocks that cover 0 .. size - 1. The last one is moved back to end with the last
/// vertex: its first `skip` lanes come up for the second time. `first` is negative if there are fewer vertices than
/// lanes.
template <class Block>
HWY_INLINE void for_blocks(Index size, const Block& block) {
  Index i = 0;
  for (; i + lanes <= size; i += lanes) block(static_cast<std::ptrdiff_t>(i), 0u);
  if (i < size) block(static_cast<std::ptrdiff_t>(size) - static_cast<std::ptrdiff_t>(lanes), lanes - (size - i));
}

/// Where a run is copied to if it has fewer vertices than lanes.
struct Copy {
  float x[lanes], y[lanes], z[lanes];
};

/// A run in front of which for_blocks() may read: the run itself, or its copy, led by repetitions of the first vertex.
HWY_INLINE Run readable(const Run& run, Copy& copy) {
  if (HWY_LIKELY(run.size >= lanes)) return run;
  const Index skip = lanes - run.size;
  for (Index lane = 0; lane < lanes; ++lane) {
    const Index v = lane < skip ? 0 : lane - skip;
    copy.x[lane] = run.x[v];
    copy.y[lane] = run.y[v];
    copy.z[lane] = run.z[v];
  }
  return {copy.x + skip, copy.y + skip, copy.z + skip, run.size};
}

HWY_INLINE V squared_length(V x, V y, V z) {  // as squared_distance()
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

HWY_INLINE float least(V v) { return hn::GetLane(hn::MinOfLanes(Floats(), v)); }
HWY_INLINE float most(V v) { return hn::GetLane(hn::MaxOfLanes(Floats(), v)); }
HWY_INLINE float sum(V v) { return hn::GetLane(hn::SumOfLanes(Floats(), v)); }

bool all_finite(const Run& run) {
  for (Index v = 0; v < run.size; ++v) {
    if (!std::isfinite(run.x[v]) || !std::isfinite(run.y[v]) || !std::isfinite(run.z[v])) return false;
  }
  return true;
}

Bound BoundOf(const Run& run) {
  Copy copy;
  const Run at = readable(run, copy);
  V lx = all(run.x[0]), ly = all(run.y[0]), lz = all(run.z[0]), hx = lx, hy = ly, hz = lz;
  for_blocks(run.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V x = load(at.x + i), y = load(at.y + i), z = load(at.z + i);
    lx = hn::Min(lx, x), ly = hn::Min(ly, y), lz = hn::Min(lz, z);
    hx = hn::Max(hx, x), hy = hn::Max(hy, y), hz = hn::Max(hz, z);
  });
  Bound bound;
  bound.box = {{least(lx), least(ly), least(lz)}, {most(hx), most(hy), most(hz)}};
  bound.centre = bound.box.lo * 0.5f + bound.box.hi * 0.5f;
  bound.largest =
      std::max({-bound.box.lo.x, -bound.box.lo.y, -bound.box.lo.z, bound.box.hi.x, bound.box.hi.y, bound.box.hi.z});

  const V cx = all(bound.centre.x), cy = all(bound.centre.y), cz = all(bound.centre.z);
  V farthest = hn::Zero(Floats()), total = farthest;
  for_blocks(run.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V d2 = squared_length(hn::Sub(load(at.x + i), cx), hn::Sub(load(at.y + i), cy), hn::Sub(load(at.z + i), cz));
    farthest = hn::Max(farthest, d2);
    total = hn::Add(total, d2);
  });
  // Four units of rounding, and what products lose by underflow. NaN and infinity show in the sum; so does overflow.
  bound.radius = static_cast<float>(std::sqrt(double{most(farthest)} + 0x1p-147) * (1 + 0x1p-21));
  bound.finite = std::isfinite(sum(total)) || all_finite(run);
  if (!std::isfinite(sum(total))) bound.radius = std::numeric_limits<float>::infinity();
  return bound;
}

/// One bit a vertex: bits come in by the block, in order. The words must have room for whole blocks.
class BitWriter {
 public:
  explicit BitWriter(std::uint64_t* words) : at_(reinterpret_cast<std::uint8_t*>(words)) {}
  HWY_INLINE void add(std::uint64_t bits) {
    if constexpr (lanes == 16) {
      const auto half = static_cast<std::uint16_t>(bits);
      std::memcpy(at_, &half, 2);
      at_ += 2;
    } else if constexpr (lanes == 8) {
      *at_++ = static_cast<std::uint8_t>(bits);
    } else {
      *at_ = static_cast<std::uint8_t>(used_ == 0 ? bits : *at_ | bits << used_);
      used_ = (used_ + lanes) % 8;
      at_ += used_ == 0;
    }
  }
  /// Fills the last word up.
  HWY_INLINE void end() { std::memset(at_ + (used_ > 0), 0, 8); }

 private:
  std::uint8_t* at_;
  Index used_ = 0;
};

template <class Visit>
HWY_INLINE void for_bits(const std::uint64_t* words, Index bits, const Visit& visit) {
  for (Index first = 0; first < bits; first += 64) {
    for (std::uint64_t word = *words++; word != 0; word &= word - 1) {
      visit(first + static_cast<Index>(std::countr_zero(word)));
    }
  }
}

/// The numbers of the set bits, ascending. Eight at a time whether they are there or not, for how many there are is
/// what a processor cannot foresee; then eight zeros. Returns how many.
HWY_INLINE Index list_bits(const std::uint64_t* words, Index bits, Index* list) {
  Index size = 0;
  for (Index first = 0; first < bits; first += 64) {
    std::uint64_t word = *words++;
    const auto count = static_cast<Index>(std::popcount(word));
    Index* to = list + size;
    for (Index done = 0; done < count || done == 0; done += 8) {
      for (Index k = 0; k < 8; ++k) {
        *to++ = first + static_cast<Index>(std::countr_zero(word));
        word &= word - 1;
      }
    }
    size += count;
  }
  std::fill_n(list + size, 8, 0);
  return size;
}

/// Picks the vertices of a list by list_bits().
HWY_INLINE void pick(const Run& run, Index first, const Index* list, Index size, Picked& picked) {
  float *const x = picked.x.data(), *const y = picked.y.data(), *const z = picked.z.data();
  Index* const vertex = picked.vertex.data();
  for (Index k = 0; k < size; k += 8) {
    for (Index step = 0; step < 8; ++step) {
      const Index v = list[k + step];
      x[k + step] = run.x[v];
      y[k + step] = run.y[v];
      z[k + step] = run.z[v];
      vertex[k + step] = first + v;
    }
  }
  const V nothing = all(std::numeric_limits<float>::quiet_NaN());
  for (float* end : {x + size, y + size, z + size}) hn::StoreU(nothing, Floats(), end);
  picked.size = size;
}

/// Appends the contacts of some vertices of a run, by their numbers, with picked ones of another body.
HWY_INLINE void find_contacts(const Run& a, Index first_a, const Index* list_a, Index size_a, const Picked& b,
                              float tolerance2, std::vector<std::uint64_t>& words, std::vector<Contact>& contacts) {
  Index shift = 4;  // each vertex of a takes 2^shift bits
  while (Index{1} << shift < b.size) ++shift;
  const Index row = Index{1} << shift;
  const std::size_t needed = (std::size_t{size_a} * row) / 64 + 2;
  if (HWY_UNLIKELY(words.size() < needed)) words.resize(needed);

  const float *const bx = b.x.data(), *const by = b.y.data(), *const bz = b.z.data();
  const V limit = all(tolerance2);
  BitWriter bits(words.data());
  for (Index i = 0; i < size_a; ++i) {
    const V x = all(a.x[list_a[i]]), y = all(a.y[list_a[i]]), z = all(a.z[list_a[i]]);
    for (Index j = 0; j < row; j += lanes) {
      if (HWY_UNLIKELY(j >= b.size)) {
        bits.add(0);
        continue;
      }
      const V d2 = squared_length(hn::Sub(x, load(bx + j)), hn::Sub(y, load(by + j)), hn::Sub(z, load(bz + j)));
      bits.add(bits_of(hn::Lt(d2, limit)));
    }
  }
  bits.end();
  for_bits(words.data(), size_a << shift, [&](Index bit) HWY_ATTR {
    contacts.push_back({first_a + list_a[bit >> shift], b.vertex[bit & (row - 1)]});
  });
}

Facing Face(const Run& a, Index first_a, const Run& b, Index first_b, const Slab& slab, float tolerance2,
            std::uint64_t most_tests, FacingScratch& scratch, std::vector<Contact>& contacts) {
  const V nx = all(slab.normal.x), ny = all(slab.normal.y), nz = all(slab.normal.z);
  const auto along = [nx, ny, nz](const Run& at, std::ptrdiff_t i) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(nx, load(at.x + i)), hn::Mul(ny, load(at.y + i))), hn::Mul(nz, load(at.z + i)));
  };
  float* const along_a = scratch.along_a.data() + lanes;
  std::uint64_t* const words = scratch.words.data();
  Copy copy_a, copy_b;
  const Run at_a = readable(a, copy_a), at_b = readable(b, copy_b);
  V front = all(-std::numeric_limits<float>::infinity());
  for_blocks(a.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V p = along(at_a, i);
    hn::StoreU(p, Floats(), along_a + i);
    front = hn::Max(front, p);
  });
  const V limit_b = all(most(front) + slab.reach);
  V back = all(std::numeric_limits<float>::infinity());
  BitWriter bits_b(words);
  for_blocks(b.size, [&](std::ptrdiff_t i, Index skip) HWY_ATTR {
    const V p = along(at_b, i);
    back = hn::Min(back, p);
    bits_b.add(bits_of(hn::Le(p, limit_b)) >> skip);
  });
  bits_b.end();
  const float back_b = least(back);
  if (!(back_b <= hn::GetLane(limit_b))) return {};
  Index* const list = scratch.list.data();
  pick(b, first_b, list, list_bits(words, b.size, list), scratch.near_b);

  const V limit_a = all(back_b - slab.reach);
  BitWriter bits_a(words);
  for_blocks(a.size, [&](std::ptrdiff_t i, Index skip)
                         HWY_ATTR { bits_a.add(bits_of(hn::Ge(load(along_a + i), limit_a)) >> skip); });
  bits_a.end();
  const Index size_a = list_bits(words, a.size, list);
  const std::uint64_t tests = std::uint64_t{size_a} * scratch.near_b.size;
  if (tests > most_tests) {
    pick(a, first_a, list, size_a, scratch.near_a);
    return {tests, false};
  }
  find_contacts(a, first_a, list, size_a, scratch.near_b, tolerance2, scratch.words, contacts);
  return {tests, true};
}

/// Bits of the vertices of a set, from the block of `begin` on, that are close to one point.
HWY_INLINE void close_bits(float px, float py, float pz, const Picked& set, Index begin, float tolerance2,
                           std::uint64_t* words) {
  const V x = all(px), y = all(py), z = all(pz), limit = all(tolerance2);
  const float *sx = set.x.data(), *sy = set.y.data(), *sz = set.z.data();
  BitWriter bits(words);
  for (Index j = begin; j < set.size; j += lanes) {
    bits.add(bits_of(
        hn::Lt(squared_length(hn::Sub(x, load(sx + j)), hn::Sub(y, load(sy + j)), hn::Sub(z, load(sz + j))), limit)));
  }
  bits.end();
}

void ContactsBetween(const Picked& a, const Picked& b, float tolerance2, std::size_t most, Words& words,
                     std::vector<Contact>& contacts) {
  if (words.size() < b.size / 64 + 2) words.resize(b.size / 64 + 2);
  for (Index i = 0; i < a.size; ++i) {
    close_bits(a.x[i], a.y[i], a.z[i], b, 0, tolerance2, words.data());
    for_bits(words.data(), b.size, [&](Index bit) HWY_ATTR { contacts.push_back({a.vertex[i], b.vertex[bit]}); });
    if (contacts.size() > most) throw_too_many_contacts(most);
  }
}

void ContactsWithin(const Picked& set, float tolerance2, std::size_t most, Words& words,
                    std::vector<Contact>& contacts) {
  if (words.size() < set.size / 64 + 2) words.resize(set.size / 64 + 2);
  for (Index i = 0; i + 1 < set.size; ++i) {
    const Index begin = (i + 1) / lanes * lanes;
    close_bits(set.x[i], set.y[i], set.z[i], set, begin, tolerance2, words.data());
    words[0] &= ~std::uint64_t{0} << (i + 1 - begin);
    for_bits(words.data(), set.size - begin, [&](Index bit) HWY_ATTR {
      contacts.push_back({set.vertex[i], set.vertex[begin + bit]});
    });
    if (contacts.size() > most) throw_too_many_contacts(most);
  }
}

void ContactsOf(const Picked& set, Index i, float tolerance2, Words& words, std::vector<Contact>& contacts) {
  if (words.size() < set.size / 64 + 2) words.resize(set.size / 64 + 2);
  close_bits(set.x[i], set.y[i], set.z[i], set, 0, tolerance2, words.data());
  words[i / 64] &= ~(std::uint64_t{1} << i % 64);
  for_bits(words.data(), set.size, [&](Index bit) HWY_ATTR { contacts.push_back({set.vertex[i], set.vertex[bit]}); });
}

AffineFit FitAffine(const Run& body, const Run& reference, const std::array<float, 9>& inverse_moment,
                    const glm::vec3& centre, float* residual2) {
  const V cx = all(centre.x), cy = all(centre.y), cz = all(centre.z), zero = hn::Zero(Floats());
  V xx = zero, xy = zero, xz = zero, yx = zero, yy = zero, yz = zero, zx = zero, zy = zero, zz = zero;
  V mx = zero, my = zero, mz = zero;
  const auto add_block = [&](Index i) HWY_ATTR {
    const V bx = hn::Sub(load(body.x + i), cx), by = hn::Sub(load(body.y + i), cy), bz = hn::Sub(load(body.z + i), cz);
    const V rx = load(reference.x + i), ry = load(reference.y + i), rz = load(reference.z + i);
    xx = hn::Add(xx, hn::Mul(bx, rx)), xy = hn::Add(xy, hn::Mul(bx, ry)), xz = hn::Add(xz, hn::Mul(bx, rz));
    yx = hn::Add(yx, hn::Mul(by, rx)), yy = hn::Add(yy, hn::Mul(by, ry)), yz = hn::Add(yz, hn::Mul(by, rz));
    zx = hn::Add(zx, hn::Mul(bz, rx)), zy = hn::Add(zy, hn::Mul(bz, ry)), zz = hn::Add(zz, hn::Mul(bz, rz));
    mx = hn::Add(mx, bx), my = hn::Add(my, by), mz = hn::Add(mz, bz);
  };
  Index sampled = 0;
  for (Index first = 0; first + sample_run <= body.size; first += sample_stride(body.size)) {
    for (Index i = first; i < first + sample_run; i += lanes) add_block(i);
    sampled += sample_run;
  }

  AffineFit fit;
  const std::array<float, 9> moment{sum(xx), sum(xy), sum(xz), sum(yx), sum(yy), sum(yz), sum(zx), sum(zy), sum(zz)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      fit.matrix[3 * row + column] = moment[3 * row] * inverse_moment[column] +
                                     moment[3 * row + 1] * inverse_moment[3 + column] +
                                     moment[3 * row + 2] * inverse_moment[6 + column];
    }
  }
  const float share = 1.0f / static_cast<float>(sampled);
  fit.offset = {sum(mx) * share, sum(my) * share, sum(mz) * share};

  V farthest = zero;
  const auto error = [&](std::size_t row, V b, V c, V rx, V ry, V rz) HWY_ATTR {
    const float* m = &fit.matrix[3 * row];
    const V mapped = hn::Add(hn::Add(hn::Mul(all(m[0]), rx), hn::Mul(all(m[1]), ry)), hn::Mul(all(m[2]), rz));
    return hn::Sub(hn::Sub(hn::Sub(b, c), all(fit.offset[row])), mapped);
  };
  for_blocks(body.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V rx = load(reference.x + i), ry = load(reference.y + i), rz = load(reference.z + i);
    const V e2 = squared_length(error(0, load(body.x + i), cx, rx, ry, rz), error(1, load(body.y + i), cy, rx, ry, rz),
                                error(2, load(body.z + i), cz, rx, ry, rz));
    farthest = hn::Max(farthest, e2);
    hn::StoreU(e2, Floats(), residual2 + i);
  });
  fit.residual = std::sqrt(most(farthest));
  return fit;
}

float FarthestMove(const Run& run, const Run& before) {
  Copy copy_now, copy_before;
  const Run at = readable(run, copy_now), was = readable(before, copy_before);
  V farthest = hn::Zero(Floats()), total = farthest;
  M moved = hn::FirstN(Floats(), 0);
  for_blocks(run.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V x = load(at.x + i), y = load(at.y + i), z = load(at.z + i);
    const V wx = load(was.x + i), wy = load(was.y + i), wz = load(was.z + i);
    const V d2 = squared_length(hn::Sub(x, wx), hn::Sub(y, wy), hn::Sub(z, wz));
    farthest = hn::Max(farthest, d2);
    total = hn::Add(total, d2);
    moved = hn::Or(moved, hn::Or(hn::Ne(x, wx), hn::Or(hn::Ne(y, wy), hn::Ne(z, wz))));
  });
  if (!std::isfinite(sum(total))) return std::numeric_limits<float>::infinity();
  if (hn::AllFalse(Floats(), moved)) return 0;
  return static_cast<float>(std::sqrt(double{most(farthest)} + 0x1p-147) * (1 + 0x1p-21));  // as the radius of a Bound
}

Index SweepStrip(const StripBoxes& boxes, Index i, Index begin, Index end, float reach, std::vector<Index>& found) {
  const V limit = all(reach);
  const auto along = static_cast<std::size_t>(boxes.along), side = (along + 1) % 3, other = (along + 2) % 3;
  const V lo0 = all(boxes.lo[along][i]), hi0 = all(boxes.hi[along][i]);
  const V lo1 = all(boxes.lo[side][i]), hi1 = all(boxes.hi[side][i]);
  const V lo2 = all(boxes.lo[other][i]), hi2 = all(boxes.hi[other][i]);
  const V c0 = all(boxes.centre[0][i]), c1 = all(boxes.centre[1][i]), c2 = all(boxes.centre[2][i]);
  const V radius = all(boxes.radius[i] + reach);
  Index near_boxes = 0;
  for (Index j = begin; j < end; j += lanes) {
    // Lanes beyond the strip belong to the next one.
    const M inside = hn::FirstN(Floats(), std::min(lanes, end - j));
    const M within = hn::And(inside, hn::Le(hn::Sub(load(&boxes.lo[along][j]), hi0), limit));  // a prefix of the block
    const M near0 = hn::And(within, hn::Le(hn::Sub(lo0, load(&boxes.hi[along][j])), limit));
    const M near1 = hn::And(hn::Le(hn::Sub(load(&boxes.lo[side][j]), hi1), limit),
                            hn::Le(hn::Sub(lo1, load(&boxes.hi[side][j])), limit));
    const M near2 = hn::And(hn::Le(hn::Sub(load(&boxes.lo[other][j]), hi2), limit),
                            hn::Le(hn::Sub(lo2, load(&boxes.hi[other][j])), limit));
    const M near = hn::And(near0, hn::And(near1, near2));
    if (!hn::AllFalse(Floats(), near)) {
      const V d2 = squared_length(hn::Sub(load(&boxes.centre[0][j]), c0), hn::Sub(load(&boxes.centre[1][j]), c1),
                                  hn::Sub(load(&boxes.centre[2][j]), c2));
      // A relative margin for the rounding of both sides, an absolute one for their underflow; overflow makes both inf.
      const V reached = hn::Add(radius, load(&boxes.radius[j]));
      const V most2 = hn::Add(hn::Mul(hn::Mul(reached, reached), all(1 + 0x1p-18f)), all(1e-37f));
      near_boxes += static_cast<Index>(hn::CountTrue(Floats(), near));
      for (std::uint64_t bits = bits_of(hn::And(near, hn::Not(hn::Gt(d2, most2)))); bits != 0; bits &= bits - 1) {
        found.push_back(j + static_cast<Index>(std::countr_zero(bits)));
      }
    }
    if (!hn::AllTrue(Floats(), within)) break;
  }
  return near_boxes;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide {

HWY_EXPORT(BoundOf);
HWY_EXPORT(Face);
HWY_EXPORT(ContactsBetween);
HWY_EXPORT(ContactsWithin);
HWY_EXPORT(ContactsOf);
HWY_EXPORT(FitAffine);
HWY_EXPORT(FarthestMove);
HWY_EXPORT(SweepStrip);

Bound bound_of(const Run& run) { return HWY_DYNAMIC_DISPATCH(BoundOf)(run); }

Facing face(const Run& a, Index first_a, const Run& b, Index first_b, const Slab& slab, float tolerance2,
            std::uint64_t most_tests, FacingScratch& scratch, std::vector<Contact>& contacts) {
  scratch.reserve(a.size, b.size);
  return HWY_DYNAMIC_DISPATCH(Face)(a, first_a, b, first_b, slab, tolerance2, most_tests, scratch, contacts);
}

void FacingScratch::reserve(Index size_a, Index size_b) {
  const std::size_t size = std::max(size_a, size_b);
  if (along_a.size() >= size + Picked::padding) return;
  along_a.resize(size + Picked::padding);
  words.resize(size / 64 + 2);
  list.resize(size + 2 * Picked::padding);
  near_a.reserve(static_cast<Index>(list.size()));
  near_b.reserve(static_cast<Index>(list.size()));
}

void throw_too_many_contacts(std::size_t most) {
  throw std::length_error("more than " + std::to_string(most) + " contacts in one frame: lower the tolerance");
}

void contacts_between(const Picked& a, const Picked& b, float tolerance2, std::size_t most, Words& words,
                      std::vector<Contact>& contacts) {
  HWY_DYNAMIC_DISPATCH(ContactsBetween)(a, b, tolerance2, most, words, contacts);
}

void contacts_within(const Picked& set, float tolerance2, std::size_t most, Words& words,
                     std::vector<Contact>& contacts) {
  HWY_DYNAMIC_DISPATCH(ContactsWithin)(set, tolerance2, most, words, contacts);
}

void contacts_of(const Picked& set, Index i, float tolerance2, Words& words, std::vector<Contact>& contacts) {
  HWY_DYNAMIC_DISPATCH(ContactsOf)(set, i, tolerance2, words, contacts);
}

AffineFit fit_affine(const Run& body, const Run& reference, const std::array<float, 9>& inverse_moment,
                     const glm::vec3& centre, std::span<float> residual2) {
  return HWY_DYNAMIC_DISPATCH(FitAffine)(body, reference, inverse_moment, centre, residual2.data());
}

float farthest_move(const Run& run, const Run& before) { return HWY_DYNAMIC_DISPATCH(FarthestMove)(run, before); }

Index sweep_strip(const StripBoxes& boxes, Index i, Index begin, Index end, float reach, std::vector<Index>& found) {
  return HWY_DYNAMIC_DISPATCH(SweepStrip)(boxes, i, begin, end, reach, found);
}

void Picked::reserve(Index count) {
  if (x.size() >= std::size_t{count} + padding) return;
  for (auto* coordinate : {&x, &y, &z}) coordinate->resize(std::size_t{count} + padding);
  vertex.resize(count);
}

void Picked::end() {
  for (Index k = size; k < size + padding; ++k) {
    x[k] = y[k] = z[k] = std::numeric_limits<float>::quiet_NaN();
  }
}

void Picked::take(const Run& run, Index first) {
  reserve(run.size);
  size = 0;
  for (Index v = 0; v < run.size; ++v) add(run.x[v], run.y[v], run.z[v], first + v);
  end();
}

void StripBoxes::resize(Index count) {
  size = count;
  for (auto* bounds : {&lo, &hi, &centre}) {
    for (auto& values : *bounds) values.resize(std::size_t{count} + Picked::padding);
  }
  radius.resize(std::size_t{count} + Picked::padding);
}

}  // namespace collide
#endif  // HWY_ONCE
