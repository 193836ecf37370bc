#include "collide/exact/patched_shape.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/common.hpp>

#include "collide/trees/patch_cut.h"

namespace collide::exact {

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

double spread_of(const BoxColumns& boxes, Range patches) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index patch = patches.begin; patch < patches.end; ++patch)
      sum += double{boxes.hi[axis][patch]} - double{boxes.lo[axis][patch]};
  return sum;
}

PatchedShape::PatchedShape(const std::shared_ptr<const Shape>& shape, const VertexRun& body) : shape_(shape) {
  std::array<std::vector<float>, 3> rest;
  for (auto& values : rest) values.reserve(shape->rest().size());
  for (const glm::vec3& p : shape->rest())
    for (int axis = 0; axis < 3; ++axis) rest[static_cast<std::size_t>(axis)].push_back(p[axis]);
  const bool finite = !rest[0].empty() && std::ranges::all_of(rest, [](const std::vector<float>& values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
  });
  cut(finite ? VertexRun{rest[0].data(), rest[1].data(), rest[2].data(), body.size} : body);
  of_rest_ = finite;
}

void PatchedShape::cut(const VertexRun& body) {
  const std::vector<glm::vec3>& at_rest = shape()->rest();
  std::vector<trees::Item> items;
  items.reserve(body.size);
  for (Index v = 0; v < body.size; ++v) items.push_back({{body.x[v], body.y[v], body.z[v]}, v});
  trees::cut_into_patches(items);
  const Index groups = (body.size + Patches::group_size - 1) / Patches::group_size;
  vertex_.assign(std::size_t{groups} * Patches::group_size, items.back().number);
  slot_.resize(body.size);
  for (auto& values : rest_) values.assign(vertex_.size(), nan);
  for (Index slot = 0; slot < body.size; ++slot) {
    const Index v = items[slot].number;
    vertex_[slot] = v;
    slot_[v] = slot;
    if (at_rest.empty()) continue;
    for (int axis = 0; axis < 3; ++axis) rest_[static_cast<std::size_t>(axis)][slot] = at_rest[v][axis];
  }
  reference_.resize(groups);
  fill_groups(body, vertex_.data(), {0, groups}, 0, ByteUnit(1), reference_);
  spread = spread_of(reference_.patch, {0, patches()});
  reference_.at = {};  // of the reference only boxes are needed
  reference_.bytes = {};
  of_rest_ = false;
  tolerance2_ = 0;
}

void PatchedShape::list_pairs(float tolerance2, float cutoff) {
  if (tolerance2 == tolerance2_) return;
  tolerance2_ = 0;  // should this fail half-way
  known_ = {};
  const std::shared_ptr<const Shape> shape = this->shape();
  listed_.assign(patches(), 0);
  GroupHits near;
  const float reach = 1.25f * cutoff;  // pairs that soon come near are as good as near
  known_.first_group.push_back(0);
  known_.other.reserve(std::size_t{8} * patches());
  known_.mask.reserve(std::size_t{8} * patches());
  known_.other.push_back(0);  // stands for patches that are not listed
  known_.mask.push_back({});
  known_.first_other.push_back(1);
  for (Index group = 0; group < groups(); ++group) {
    list_near_groups(reference_, group, {group, groups()}, nullptr, 0, reach, near);
    for (const auto& [other, rows] : near.near) known_.group.push_back(other);
    known_.rows.resize(known_.group.size());
    for (Index k = 0; k < reference_.count[group]; ++k)
      list_pairs(shape->topology(), group * Patches::size + k, tolerance2, reach, near);
    known_.first_group.push_back(static_cast<Index>(known_.group.size()));
  }
  tolerance2_ = tolerance2;
}

void PatchedShape::list_pairs(const Topology& topology, Index patch, float tolerance2, float cutoff, GroupHits& near) {
  const Index row = patch % Patches::size;
  const Index count = list_near_patches(reference_, patch, cutoff, near);
  Index at = known_.first_group.back();
  known_.rows[at][row] = static_cast<std::uint16_t>((1u << row) - 1);  // earlier patches find it
  for (const Index other : std::span(near.list).first(count)) {
    if (other < patch || (other != patch && known_.mask.size() >= most_masks * patches())) continue;
    while (known_.group[at] != other / Patches::size) ++at;
    known_.rows[at][row] |= static_cast<std::uint16_t>(1u << other % Patches::size);
    listed_[other] = static_cast<Index>(known_.other.size());
    known_.other.push_back(other);
    known_.mask.push_back(close_pairs(rest_, patch, other, tolerance2));
    for (std::uint64_t& word : known_.mask.back()) word = ~word;
    if (other != patch) continue;
    for (Index k = 0; k < Patches::size; ++k)  // each pair once
      known_.mask.back()[k / 4] &= ~(((std::uint64_t{2} << k) - 1) << k % 4 * Patches::size);
  }
  leave_out_joined(topology, patch);
  const std::size_t first = known_.first_other.back();
  for (std::size_t n = first; n < known_.other.size(); ++n) listed_[known_.other[n]] = 0;
  std::size_t kept = first;
  for (std::size_t n = first; n < known_.other.size(); ++n) {
    known_.other[kept] = known_.other[n];
    known_.mask[kept] = known_.mask[n];
    kept += known_.mask[n] != KnownPairs::Mask{};
  }
  known_.other.resize(kept);
  known_.mask.resize(kept);
  known_.first_other.push_back(static_cast<Index>(kept));
}

/// Clears the bits of pairs of a patch that mesh edges join.
void PatchedShape::leave_out_joined(const Topology& topology, Index patch) {
  const Index begin = patch * Patches::size, end = std::min(begin + Patches::size, static_cast<Index>(slot_.size()));
  for (Index slot = begin; slot < end; ++slot) {
    const Index k = slot - begin;
    for (const Index neighbour : topology.neighbours(vertex_[slot])) {
      const Index other = slot_[neighbour];
      const Index bit = k % 4 * Patches::size + other % Patches::size;
      known_.mask[listed_[other / Patches::size]][k / 4] &= ~(std::uint64_t{1} << bit);
    }
  }
}

}  // namespace collide::exact
