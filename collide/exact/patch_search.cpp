#include "collide/exact/patch_search.h"

#include <cassert>
#include <limits>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace collide::exact {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float squared_length(const glm::vec3& side) { return squared_distance(side.x, side.y, side.z, 0, 0, 0); }

/// Returns what squared_distance() of two points in these boxes is at least, and at most. Each of its steps rounds
/// monotonically, so that these bounds need no margin.
float least_squared_distance(const Aabb& a, const Aabb& b) {
  return squared_length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), glm::vec3(0)));
}
float greatest_squared_distance(const Aabb& a, const Aabb& b) {
  return squared_length(glm::max(a.hi - b.lo, b.hi - a.lo));
}

void put(std::array<std::vector<float>, 3>& to, std::size_t at, const glm::vec3& p) {
  to[0][at] = p.x, to[1][at] = p.y, to[2][at] = p.z;
}

}  // namespace

void PatchSearch::begin(const Frame& frame, std::span<const Index> which, float tolerance2, Workers& workers) {
  static_assert(trees::BodyTrees::patch_size <= max_lanes);
  assert(!which.empty());
  const bool fresh = trees_.update(frame, which, workers);
  patches_.now = &trees_.points();
  pairs_.clear();
  if (fresh) {
    which_.assign(which.begin(), which.end());
    take_rest(frame);
    number_patches();
  }
  if (fresh || tolerance2 != tolerance2_) {
    tolerance2_ = tolerance2;
    list_joined(frame);
  }
  for (std::size_t patch = 0; patch < node_of_patch_.size(); ++patch) {
    const Aabb& box = trees_.nodes()[node_of_patch_[patch]].box;
    put(patches_.lo, patch, box.lo);
    put(patches_.hi, patch, box.hi);
  }
}

void PatchSearch::take_rest(const Frame& frame) {
  const Points& now = *patches_.now;
  for (auto* rest : {&patches_.rest_x, &patches_.rest_y, &patches_.rest_z}) {
    rest->assign(now.x.size(), std::numeric_limits<float>::quiet_NaN());
  }
  for (Index slot = 0; slot < now.size(); ++slot) {
    const Index body = now.body[slot];
    const std::vector<glm::vec3>& rest = frame.bodies->shape[body]->rest();
    if (rest.empty()) continue;
    const glm::vec3& at = rest[now.vertex[slot] - frame.bodies->first[body]];
    patches_.rest_x[slot] = at.x;
    patches_.rest_y[slot] = at.y;
    patches_.rest_z[slot] = at.z;
  }
}

/// Numbers the patches of all bodies by their slots, so that those of a node have consecutive numbers.
void PatchSearch::number_patches() {
  const std::span<const trees::Node> nodes = trees_.nodes();
  node_of_patch_.clear();
  for (auto node = static_cast<Index>(trees_.root(0)); node < nodes.size(); ++node) {
    if (nodes[node].is_leaf()) node_of_patch_.push_back(node);
  }
  std::sort(node_of_patch_.begin(), node_of_patch_.end(),
            [&](Index a, Index b) { return nodes[a].first < nodes[b].first; });
  for (auto* bounds : {&patches_.lo, &patches_.hi, &patches_.rest_lo, &patches_.rest_hi}) {
    for (std::vector<float>& values : *bounds) values.resize(node_of_patch_.size() + max_lanes);
  }
  patches_.first_slot.clear();
  about_.resize(nodes.size());
  for (Index patch = 0; patch < node_of_patch_.size(); ++patch) {
    const Range slots = nodes[node_of_patch_[patch]].slots();
    Aabb rest{glm::vec3(infinity), glm::vec3(-infinity)};
    for (Index slot = slots.begin; slot < slots.end; ++slot) {
      const glm::vec3 p(patches_.rest_x[slot], patches_.rest_y[slot], patches_.rest_z[slot]);
      const bool known = !glm::any(glm::isnan(p));
      rest = joint(rest, known ? Aabb{p, p} : Aabb{glm::vec3(-infinity), glm::vec3(infinity)});
    }
    put(patches_.rest_lo, patch, rest.lo);
    put(patches_.rest_hi, patch, rest.hi);
    patches_.first_slot.push_back(slots.begin);
    about_[node_of_patch_[patch]] = {rest, {patch, patch + 1}, patches_.now->body[slots.begin]};
  }
  patches_.first_slot.push_back(patches_.now->size());
  for (std::size_t node = nodes.size(); node-- > trees_.root(0);) {
    if (nodes[node].is_leaf()) continue;
    const About &low = about_[nodes[node].first], &up = about_[nodes[node].first + std::size_t{1}];
    about_[node] = {joint(low.rest, up.rest), {low.patches.begin, up.patches.end}, low.body};
  }
}

void PatchSearch::list_joined(const Frame& frame) {
  const Points& now = *patches_.now;
  std::vector<Index> slot_of(frame.bodies->vertex_count());
  for (Index slot = 0; slot < now.size(); ++slot) slot_of[now.vertex[slot]] = slot;
  patches_.joined.clear();
  patches_.first_joined.assign(1, 0);
  for (Index slot = 0; slot < now.size(); ++slot) {
    const Index body = now.body[slot], first = frame.bodies->first[body];
    for (const Index neighbour : frame.bodies->shape[body]->topology().neighbours(now.vertex[slot] - first)) {
      const Index other = slot_of[first + neighbour];
      const float d2 = squared_distance(patches_.rest_x[slot], patches_.rest_y[slot], patches_.rest_z[slot],
                                        patches_.rest_x[other], patches_.rest_y[other], patches_.rest_z[other]);
      if (!(d2 < tolerance2_)) patches_.joined.push_back(other);
    }
    patches_.first_joined.push_back(static_cast<Index>(patches_.joined.size()));
  }
}

void PatchSearch::add(Index a, Index b) {
  const auto root = [&](Index body) {
    const auto at = std::lower_bound(which_.begin(), which_.end(), body);
    assert(at != which_.end() && *at == body);
    return trees_.root(static_cast<std::size_t>(at - which_.begin()));
  };
  pairs_.push_back({root(a), root(b)});
}

std::size_t PatchSearch::deal(int threads) {
  node_pairs().deal(pairs_, threads, [&](trees::NodePair pair) { return apart(pair); });
  return pairs_.size();
}

bool PatchSearch::apart(trees::NodePair pair) const {
  const About &a = about_[pair.a], &b = about_[pair.b];
  if (a.body == b.body && greatest_squared_distance(a.rest, b.rest) < tolerance2_) return true;
  const std::span<const trees::Node> nodes = trees_.nodes();
  return least_squared_distance(nodes[pair.a].box, nodes[pair.b].box) >= tolerance2_;
}

PatchSearch::Found PatchSearch::find(std::size_t task, std::size_t max_contacts, std::vector<Contact>& contacts) const {
  constexpr std::size_t room = std::size_t{most_patches} * max_lanes * max_lanes;  // of a patch
  const bool self = about_[pairs_[task].a].body == about_[pairs_[task].b].body;
  Found found;
  std::size_t size = contacts.size();
  const auto test = [&](trees::NodePair pair) {
    const Range a = about_[pair.a].patches;
    Range others = about_[pair.b].patches;
    for (Index patch = a.begin; patch < a.end; ++patch) {
      if (pair.a == pair.b) others.begin = patch;
      if (contacts.size() < size + room) contacts.resize(size + 2 * room);
      const PatchContacts more =
          find_patch_contacts(patches_, self, patch, others, tolerance2_, contacts.data() + size);
      found.pair_tests += more.pair_tests;
      size += more.contacts;
      if (size > max_contacts) throw_too_many_contacts(max_contacts);
    }
  };
  const std::size_t before = size;
  node_pairs().for_each_below(
      pairs_[task], [&](trees::NodePair pair) { return apart(pair); }, test);
  contacts.resize(size);
  if (self) found.self_contacts = size - before;
  return found;
}

std::vector<DebugGeometry::Box> PatchSearch::boxes() const {
  std::vector<DebugGeometry::Box> boxes;
  for (const Index node : node_of_patch_) {
    const Aabb& box = trees_.nodes()[node].box;
    boxes.push_back({box.lo, box.hi, about_[node].body});
  }
  return boxes;
}

}  // namespace collide::exact
