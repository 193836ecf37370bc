#include "collide/exact/pair_kernels.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/exact/pair_kernels.cpp"
#include <hwy/foreach_target.h>

#include "collide/core/simd_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace collide::exact {
namespace HWY_NAMESPACE {
namespace {

using namespace collide::HWY_NAMESPACE;

/// One bit a vertex: bits come in by the block, in order. The words must have room for whole blocks, and one more.
class BitWriter {
 public:
  explicit BitWriter(std::uint64_t* words) : at_(words) {}
  HWY_INLINE void add(std::uint64_t bits) {
    word_ |= bits << used_;
    used_ += lanes;
    if (used_ == 64) end();
  }
  HWY_INLINE void end() {
    *at_++ = word_;
    word_ = 0;
    used_ = 0;
  }

 private:
  std::uint64_t* at_;
  std::uint64_t word_ = 0;
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

/// Picks the listed vertices.
HWY_INLINE void pick(const VertexRun& run, Index first, const Index* list, Index size, VertexSet& picked) {
  float *const x = picked.x.data(), *const y = picked.y.data(), *const z = picked.z.data();
  Index* const vertex = picked.vertex.data();
  for (Index k = 0; k < size; ++k) {
    const Index v = list[k];
    x[k] = run.x[v];
    y[k] = run.y[v];
    z[k] = run.z[v];
    vertex[k] = first + v;
  }
  const V nothing = all(std::numeric_limits<float>::quiet_NaN());
  for (float* end : {x + size, y + size, z + size}) hn::StoreU(nothing, Floats(), end);
  picked.size = size;
}

/// Appends the contacts of some vertices of a run, by their numbers, with picked ones of another body.
HWY_INLINE void find_contacts(const VertexRun& a, Index first_a, const Index* list_a, Index size_a, const VertexSet& b,
                              float tolerance2, std::vector<std::uint64_t>& words, std::vector<Contact>& contacts) {
  Index shift = std::countr_zero(lanes);  // each vertex of a takes 2^shift bits
  while (Index{1} << shift < b.size) ++shift;
  const Index row = Index{1} << shift;
  const std::size_t needed = (std::size_t{size_a} * row) / 64 + 2;
  if (HWY_UNLIKELY(words.size() < needed)) words.resize(needed);

  const float *const bx = b.x.data(), *const by = b.y.data(), *const bz = b.z.data();
  const V first_x = load(bx), first_y = load(by), first_z = load(bz), limit = all(tolerance2);
  BitWriter bits(words.data());
  for (Index i = 0; i < size_a; ++i) {
    const V x = all(a.x[list_a[i]]), y = all(a.y[list_a[i]]), z = all(a.z[list_a[i]]);
    const auto close = [&](V at_x, V at_y, V at_z) HWY_ATTR {
      return bits_of(Floats(), hn::Lt(squared_length(hn::Sub(x, at_x), hn::Sub(y, at_y), hn::Sub(z, at_z)), limit));
    };
    bits.add(close(first_x, first_y, first_z));
    for (Index j = lanes; j < row; j += lanes) {
      bits.add(HWY_LIKELY(j < b.size) ? close(load(bx + j), load(by + j), load(bz + j)) : 0);
    }
  }
  bits.end();
  for_bits(words.data(), size_a << shift, [&](Index bit) HWY_ATTR {
    contacts.push_back({first_a + list_a[bit >> shift], b.vertex[bit & (row - 1)]});
  });
}

FacingResult FindFacingContacts(const VertexRun& a, Index first_a, const VertexRun& b, Index first_b, const Slab& slab,
                                float tolerance2, std::uint64_t max_tests, FacingScratch& scratch,
                                std::vector<Contact>& contacts) {
  const V nx = all(slab.normal.x), ny = all(slab.normal.y), nz = all(slab.normal.z);
  const auto along = [nx, ny, nz](const VertexRun& at, std::ptrdiff_t i) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(nx, load(at.x + i)), hn::Mul(ny, load(at.y + i))), hn::Mul(nz, load(at.z + i)));
  };
  float* const along_a = scratch.along_a.data() + lanes;
  Copy copy_a, copy_b;
  const VertexRun at_a = readable(a, copy_a), at_b = readable(b, copy_b);
  V front = all(-std::numeric_limits<float>::infinity());
  for_blocks(a.size, [&](std::ptrdiff_t i, Index) HWY_ATTR {
    const V p = along(at_a, i);
    hn::StoreU(p, Floats(), along_a + i);
    front = hn::Max(front, p);
  });
  const V limit_b = all(most(front) + slab.cutoff);
  V back = all(std::numeric_limits<float>::infinity());
  Index* const list = scratch.list.data();
  ListWriter list_b(list);
  for_blocks(b.size, [&](std::ptrdiff_t i, Index skip) HWY_ATTR {
    const V p = along(at_b, i);
    back = hn::Min(back, p);
    list_b.add(hn::Le(p, limit_b), i, skip);
  });
  const float back_b = least(back);
  if (!(back_b <= hn::GetLane(limit_b))) return {};
  pick(b, first_b, list, list_b.size(), scratch.near_b);

  const V limit_a = all(back_b - slab.cutoff);
  ListWriter list_a(list);
  for_blocks(a.size,
             [&](std::ptrdiff_t i, Index skip) HWY_ATTR { list_a.add(hn::Ge(load(along_a + i), limit_a), i, skip); });
  const std::uint64_t tests = std::uint64_t{list_a.size()} * scratch.near_b.size;
  if (tests > max_tests) {
    pick(a, first_a, list, list_a.size(), scratch.near_a);
    return {tests, false};
  }
  find_contacts(a, first_a, list, list_a.size(), scratch.near_b, tolerance2, scratch.words, contacts);
  return {tests, true};
}

void ContactsBetween(const VertexSet& a, const VertexSet& b, float tolerance2, std::size_t max_contacts, Words& words,
                     std::vector<Contact>& contacts) {
  if (words.size() < b.size / 64 + 2) words.resize(b.size / 64 + 2);
  const V limit = all(tolerance2);
  for (Index i = 0; i < a.size; ++i) {
    const V x = all(a.x[i]), y = all(a.y[i]), z = all(a.z[i]);
    BitWriter bits(words.data());
    for (Index j = 0; j < b.size; j += lanes) {
      const V d2 = squared_length(hn::Sub(x, load(&b.x[j])), hn::Sub(y, load(&b.y[j])), hn::Sub(z, load(&b.z[j])));
      bits.add(bits_of(Floats(), hn::Lt(d2, limit)));
    }
    bits.end();
    for_bits(words.data(), b.size, [&](Index bit) HWY_ATTR { contacts.push_back({a.vertex[i], b.vertex[bit]}); });
    if (contacts.size() > max_contacts) throw_too_many_contacts(max_contacts);
  }
}

void ContactsOf(const VertexRun& run, Index first, Index i, float tolerance2, Words& words,
                std::vector<Contact>& contacts) {
  if (words.size() < run.size / 64 + 2) words.resize(run.size / 64 + 2);
  Copy copy;
  const VertexRun at = readable(run, copy);
  const V x = all(run.x[i]), y = all(run.y[i]), z = all(run.z[i]), limit = all(tolerance2);
  BitWriter bits(words.data());
  for_blocks(run.size, [&](std::ptrdiff_t j, Index skip) HWY_ATTR {
    const V d2 = squared_length(hn::Sub(x, load(at.x + j)), hn::Sub(y, load(at.y + j)), hn::Sub(z, load(at.z + j)));
    bits.add(bits_of(Floats(), hn::Lt(d2, limit)) >> skip);
  });
  bits.end();
  words[i / 64] &= ~(std::uint64_t{1} << i % 64);
  for_bits(words.data(), run.size, [&](Index bit) HWY_ATTR { contacts.push_back({first + i, first + bit}); });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

HWY_EXPORT(FindFacingContacts);
HWY_EXPORT(ContactsBetween);
HWY_EXPORT(ContactsOf);

FacingResult find_facing_contacts(const VertexRun& a, Index first_a, const VertexRun& b, Index first_b,
                                  const Slab& slab, float tolerance2, std::uint64_t max_tests, FacingScratch& scratch,
                                  std::vector<Contact>& contacts) {
  scratch.reserve(a.size, b.size);
  return HWY_DYNAMIC_DISPATCH(FindFacingContacts)(a, first_a, b, first_b, slab, tolerance2, max_tests, scratch,
                                                  contacts);
}

void FacingScratch::reserve(Index size_a, Index size_b) {
  const std::size_t size = std::max(size_a, size_b);
  if (along_a.size() >= size + VertexSet::padding) return;
  along_a.resize(size + VertexSet::padding);
  words.resize(size / 64 + 2);
  list.resize(size + 2 * VertexSet::padding);
  near_a.reserve(static_cast<Index>(list.size()));
  near_b.reserve(static_cast<Index>(list.size()));
}

void contacts_between(const VertexSet& a, const VertexSet& b, float tolerance2, std::size_t max_contacts, Words& words,
                      std::vector<Contact>& contacts) {
  HWY_DYNAMIC_DISPATCH(ContactsBetween)(a, b, tolerance2, max_contacts, words, contacts);
}

void contacts_of(const VertexRun& run, Index first, Index i, float tolerance2, Words& words,
                 std::vector<Contact>& contacts) {
  HWY_DYNAMIC_DISPATCH(ContactsOf)(run, first, i, tolerance2, words, contacts);
}

void VertexSet::reserve(Index count) {
  if (x.size() >= std::size_t{count} + padding) return;
  for (auto* coordinate : {&x, &y, &z}) coordinate->resize(std::size_t{count} + padding);
  vertex.resize(count);
}

void VertexSet::end() {
  for (Index k = size; k < size + padding; ++k) {
    x[k] = y[k] = z[k] = std::numeric_limits<float>::quiet_NaN();
  }
}

void VertexSet::take(const VertexRun& run, Index first) {
  reserve(run.size);
  size = 0;
  for (Index v = 0; v < run.size; ++v) add(run.x[v], run.y[v], run.z[v], first + v);
  end();
}

}  // namespace collide::exact
#endif  // HWY_ONCE
