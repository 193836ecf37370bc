#pragma once
// The inner loops over patches: runs of neighbouring vertices of a body. Vectorised with Highway, which chooses the
// processor's instruction set at run time. Every instruction set finds the same hits in the same order.

#include <array>
#include <cmath>
#include <vector>

#include "collide/core/points.h"
#include "collide/core/vertex_run.h"
#include "collide/trees/patch_cut.h"

namespace collide::exact {

/// How coordinates become bytes. With a power of two P, a coordinate x becomes the whole number q = trunc(x P), where
/// nothing is rounded but the fraction cut off, and then the low byte of floor(q factor / 2^24), in integers that wrap
/// around. Both are monotone. So if two coordinates differ by at most the cutoff, their q differ by at most
/// floor(cutoff P) + 1 <= 128, and their bytes by at most `reach`; bytes that wrap around, and numbers beyond all
/// integers, only let more pairs pass.
struct ByteUnit {
  static constexpr std::uint8_t reach = 10;
  float per_metre = 0;  // P
  std::uint32_t factor = 0;

  explicit ByteUnit(float cutoff);
};

/// Patches of up to `size` vertices, in groups of up to `size` patches. A vertex has a lane of its patch: its place is
/// patch * size + lane. A patch that is not there is near nothing.
struct Patches {
  static constexpr Index size = trees::patch_size, group_size = size * size;

  std::array<std::vector<float>, 3> at;            // m, by place; NaN where there is no vertex
  std::array<std::vector<std::uint8_t>, 3> bytes;  // by place
  BoxColumns patch, group;
  std::vector<Index> count;     // by group: its patches
  std::vector<Index> vertices;  // by patch

  void resize(std::size_t groups);
};

/// Copies the positions of some groups of a body into the patches, and finds their bytes and boxes. vertex: of each
/// place of the body; places without a vertex repeat another one. offset: the number of the body's first group.
void fill_groups(const VertexRun& body, const Index* vertex, Range groups, Index offset, const ByteUnit& unit,
                 Patches& patches);

/// What the shape of a body says of pairs of its patches. Patches and groups count from the body's first one.
struct KnownPairs {
  using Mask = std::array<std::uint64_t, 4>;  // bit 16 i + j: lane i of the first patch, lane j of the other one
  using Rows = std::array<std::uint16_t, Patches::size>;  // of two groups: row i, bit j
  std::vector<Index> first_other, other;  // by patch: the patches, itself or later ones, that it is always tested with
  std::vector<Mask> mask;                 // of each of these pairs: the vertices that can be in contact
  std::vector<Index> first_group, group;  // by group: groups, itself or later ones, with pairs that are not to be found
  std::vector<Rows> rows;                 // of each of these pairs: such patches
};

/// The pairs of vertices of one group that are close. Keeps its memory from call to call.
struct GroupHits {
  std::vector<std::array<Index, 2>> known, found;  // places: of known pairs of patches, and of others that are near
  std::uint64_t tested = 0;                        // pairs of vertices of patches that are near each other

  /// A group that is near, and its rows of known pairs.
  struct NearGroup {
    Index group;
    const KnownPairs::Rows* rows;
  };
  std::vector<NearGroup> near;
  std::vector<Index> list;  // scratch
  struct Passed {           // four vertices of a patch and another patch, whose bytes are near
    Index a, b;             // places of their first vertices
    std::uint64_t lanes;    // bit 16 i + j: places a + i and b + j
  };
  std::vector<Passed> passed;  // the same
};

/// Lists which of some groups are near a group. known: null, or of the body whose first group is `offset` and which
/// owns all of them.
void list_near_groups(const Patches& patches, Index group, Range others, const KnownPairs* known, Index offset,
                      float cutoff, GroupHits& out);
/// Lists the patches near a patch in the groups near its own, without those of their rows. Returns how many.
Index list_near_patches(const Patches& patches, Index patch, float cutoff, GroupHits& out);
/// Finds the pairs of a group with the groups near it whose squared_distance() is below tolerance2, after
/// list_near_groups().
void find_group_hits(const Patches& patches, Index group, const KnownPairs* known, Index offset, float cutoff,
                     float tolerance2, GroupHits& out);

/// Returns which pairs of vertices of two patches have a squared_distance() below tolerance2. at: m, by place; a vertex
/// at NaN is close to none.
KnownPairs::Mask close_pairs(const std::array<std::vector<float>, 3>& at, Index a, Index b, float tolerance2);

}  // namespace collide::exact
