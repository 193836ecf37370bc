#include "collide/exact/pair_kernels.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <span>

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

/// Copies the listed vertices of a body, and pads them with NaN, which is close to nothing.
HWY_INLINE void pick(const VertexRun& run, Index first, Index size, FacingScratch& scratch) {
  float *const x = scratch.x.data(), *const y = scratch.y.data(), *const z = scratch.z.data();
  for (Index k = 0; k < size; ++k) {
    const Index v = scratch.list[k];
    x[k] = run.x[v];
    y[k] = run.y[v];
    z[k] = run.z[v];
    scratch.vertex[k] = first + v;
  }
  const V nothing = all(std::numeric_limits<float>::quiet_NaN());
  for (float* end : {x + size, y + size, z + size}) hn::StoreU(nothing, Floats(), end);
}

/// Appends the contacts of the listed vertices of a run with the picked ones of another body.
HWY_INLINE void find_contacts(const VertexRun& a, Index first_a, Index size_a, Index size_b, float tolerance2,
                              FacingScratch& scratch, std::vector<Contact>& contacts) {
  Index shift = std::countr_zero(lanes);  // each vertex of a takes 2^shift bits
  while (Index{1} << shift < size_b) ++shift;
  const Index row = Index{1} << shift;
  const float *const bx = scratch.x.data(), *const by = scratch.y.data(), *const bz = scratch.z.data();
  const Index* const list = scratch.list.data();
  const V first_x = load(bx), first_y = load(by), first_z = load(bz), limit = all(tolerance2);
  BitWriter bits(scratch.words.data());
  for (Index i = 0; i < size_a; ++i) {
    const V x = all(a.x[list[i]]), y = all(a.y[list[i]]), z = all(a.z[list[i]]);
    const auto close = [&](V at_x, V at_y, V at_z) HWY_ATTR {
      return bits_of(Floats(), hn::Lt(squared_length(hn::Sub(x, at_x), hn::Sub(y, at_y), hn::Sub(z, at_z)), limit));
    };
    bits.add(close(first_x, first_y, first_z));
    for (Index j = lanes; j < row; j += lanes) {
      bits.add(HWY_LIKELY(j < size_b) ? close(load(bx + j), load(by + j), load(bz + j)) : 0);
    }
  }
  bits.end();
  for_bits(scratch.words.data(), size_a << shift, [&](Index bit) HWY_ATTR {
    contacts.push_back({first_a + list[bit >> shift], scratch.vertex[bit & (row - 1)]});
  });
}

Index FindFacingContacts(const VertexRun& a, Index first_a, const VertexRun& b, Index first_b, const Slab& slab,
                         float tolerance2, FacingScratch& scratch, std::vector<Contact>& contacts) {
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
  if (!(back_b <= hn::GetLane(limit_b))) return 0;
  const Index facing_b = list_b.size();
  pick(b, first_b, facing_b, scratch);

  const V limit_a = all(back_b - slab.cutoff);
  ListWriter list_a(list);
  for_blocks(a.size,
             [&](std::ptrdiff_t i, Index skip) HWY_ATTR { list_a.add(hn::Ge(load(along_a + i), limit_a), i, skip); });
  const Index tests = list_a.size() * facing_b;
  if (tests <= FacingScratch::max_tests)
    find_contacts(a, first_a, list_a.size(), facing_b, tolerance2, scratch, contacts);
  return tests;
}

void ContactsOf(const VertexRun& run, Index first, Index i, float tolerance2, std::vector<Index>& scratch,
                std::vector<Contact>& contacts) {
  if (scratch.size() < run.size + std::size_t{lanes}) scratch.resize(run.size + std::size_t{lanes});
  Copy copy;
  const VertexRun at = readable(run, copy);
  const V x = all(run.x[i]), y = all(run.y[i]), z = all(run.z[i]), limit = all(tolerance2);
  ListWriter list(scratch.data());
  for_blocks(run.size, [&](std::ptrdiff_t j, Index skip) HWY_ATTR {
    const V d2 = squared_length(hn::Sub(x, load(at.x + j)), hn::Sub(y, load(at.y + j)), hn::Sub(z, load(at.z + j)));
    list.add(hn::Lt(d2, limit), j, skip);
  });
  for (const Index other : std::span(scratch).first(list.size()))
    if (other != i) contacts.push_back({first + i, first + other});
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace collide::exact
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace collide::exact {

HWY_EXPORT(FindFacingContacts);
HWY_EXPORT(ContactsOf);

Index find_facing_contacts(const VertexRun& a, Index first_a, const VertexRun& b, Index first_b, const Slab& slab,
                           float tolerance2, FacingScratch& scratch, std::vector<Contact>& contacts) {
  assert(std::max(a.size, b.size) <= FacingScratch::max_vertices);
  return HWY_DYNAMIC_DISPATCH(FindFacingContacts)(a, first_a, b, first_b, slab, tolerance2, scratch, contacts);
}

void contacts_of(const VertexRun& run, Index first, Index i, float tolerance2, std::vector<Index>& scratch,
                 std::vector<Contact>& contacts) {
  HWY_DYNAMIC_DISPATCH(ContactsOf)(run, first, i, tolerance2, scratch, contacts);
}

}  // namespace collide::exact
#endif  // HWY_ONCE
