#include "collide/pair_kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/pair_kernels.cpp"
#include <hwy/foreach_target.h>

#include "collide/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide {
namespace HWY_NAMESPACE {
namespace {

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
      bits.add(bits_of(Floats(), hn::Lt(d2, limit)));
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
    bits_b.add(bits_of(Floats(), hn::Le(p, limit_b)) >> skip);
  });
  bits_b.end();
  const float back_b = least(back);
  if (!(back_b <= hn::GetLane(limit_b))) return {};
  Index* const list = scratch.list.data();
  pick(b, first_b, list, list_bits(words, b.size, list), scratch.near_b);

  const V limit_a = all(back_b - slab.reach);
  BitWriter bits_a(words);
  for_blocks(a.size, [&](std::ptrdiff_t i, Index skip)
                         HWY_ATTR { bits_a.add(bits_of(Floats(), hn::Ge(load(along_a + i), limit_a)) >> skip); });
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
        Floats(),
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

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide {

HWY_EXPORT(Face);
HWY_EXPORT(ContactsBetween);
HWY_EXPORT(ContactsWithin);
HWY_EXPORT(ContactsOf);

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

}  // namespace collide
#endif  // HWY_ONCE
