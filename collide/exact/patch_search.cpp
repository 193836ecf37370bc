#include "collide/exact/patch_search.h"

#include <cassert>
#include <limits>

#include <glm/common.hpp>

#include "collide/core/vertex_run.h"

namespace collide::exact {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float squared_length(const glm::vec3& side) { return squared_distance(side.x, side.y, side.z, 0, 0, 0); }

/// Returns what squared_distance() of two points in these boxes is at least, and at most.
float least_squared_distance(const Aabb& a, const Aabb& b) {
  return squared_length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), glm::vec3(0)));
}
float greatest_squared_distance(const Aabb& a, const Aabb& b) {
  return squared_length(glm::max(a.hi - b.lo, b.hi - a.lo));
}

}  // namespace

void PatchSearch::begin(const Frame& frame, std::span<const Index> which, float tolerance2, Workers& workers) {
  static_assert(trees::BodyTrees::patch_size <= collide::max_lanes);
  const bool fresh = trees_.update(frame, which, workers);
  points_.now = &trees_.points();
  pairs_.clear();
  if (fresh) {
    which_.assign(which.begin(), which.end());
    take_rest(frame);
  }
  if (fresh || tolerance2 != tolerance2_) {
    tolerance2_ = tolerance2;
    list_joined(frame);
  }
}

void PatchSearch::take_rest(const Frame& frame) {
  const Points& now = *points_.now;
  for (auto* rest : {&points_.rest_x, &points_.rest_y, &points_.rest_z}) {
    rest->assign(now.x.size(), std::numeric_limits<float>::quiet_NaN());
  }
  for (Index slot = 0; slot < now.size(); ++slot) {
    const Index body = now.body[slot];
    const std::vector<glm::vec3>& rest = frame.bodies->shape[body]->rest();
    if (rest.empty()) continue;
    const glm::vec3& at = rest[now.vertex[slot] - frame.bodies->first[body]];
    points_.rest_x[slot] = at.x;
    points_.rest_y[slot] = at.y;
    points_.rest_z[slot] = at.z;
  }
  const std::span<const trees::Node> nodes = trees_.nodes();
  rest_.resize(nodes.size());
  for (std::size_t at = nodes.size(); at-- > trees_.root(0);) {
    const trees::Node& node = nodes[at];
    Aabb box{glm::vec3(infinity), glm::vec3(-infinity)};
    const auto add = [&box](const glm::vec3& lo, const glm::vec3& hi) {
      box = {glm::min(box.lo, lo), glm::max(box.hi, hi)};
    };
    if (node.is_leaf()) {
      const Range slots = node.slots();
      for (Index slot = slots.begin; slot < slots.end; ++slot) {
        const glm::vec3 p(points_.rest_x[slot], points_.rest_y[slot], points_.rest_z[slot]);
        const bool known = p == p;  // no coordinate is NaN
        add(known ? p : glm::vec3(-infinity), known ? p : glm::vec3(infinity));
      }
      rest_[at] = {box, now.body[slots.begin]};
    } else {
      for (Index child = node.first; child < node.first + node.children; ++child) {
        add(rest_[child].box.lo, rest_[child].box.hi);
      }
      rest_[at] = {box, rest_[node.first].body};
    }
  }
}

void PatchSearch::list_joined(const Frame& frame) {
  const Points& now = *points_.now;
  std::vector<Index> slot_of(frame.bodies->vertex_count());
  for (Index slot = 0; slot < now.size(); ++slot) slot_of[now.vertex[slot]] = slot;
  points_.joined.clear();
  points_.first_joined.assign(1, 0);
  for (Index slot = 0; slot < now.size(); ++slot) {
    const Index body = now.body[slot], first = frame.bodies->first[body];
    for (const Index neighbour : frame.bodies->shape[body]->topology().neighbours(now.vertex[slot] - first)) {
      const Index other = slot_of[first + neighbour];
      const float d2 = squared_distance(points_.rest_x[slot], points_.rest_y[slot], points_.rest_z[slot],
                                        points_.rest_x[other], points_.rest_y[other], points_.rest_z[other]);
      if (!(d2 < tolerance2_)) points_.joined.push_back(other);
    }
    points_.first_joined.push_back(static_cast<Index>(points_.joined.size()));
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
  trees::deal(trees_.nodes(), pairs_, threads, [&](trees::NodePair pair) { return apart(pair); });
  return pairs_.size();
}

bool PatchSearch::apart(trees::NodePair pair) const {
  const Rest &a = rest_[pair.a], &b = rest_[pair.b];
  if (a.body == b.body && greatest_squared_distance(a.box, b.box) < tolerance2_) return true;
  const std::span<const trees::Node> nodes = trees_.nodes();
  return least_squared_distance(nodes[pair.a].box, nodes[pair.b].box) >= tolerance2_;
}

PatchSearch::Found PatchSearch::find(std::size_t task, std::size_t max_contacts, std::vector<Contact>& contacts) const {
  constexpr std::size_t room = std::size_t{trees::BodyTrees::patch_size} * trees::BodyTrees::patch_size;
  const std::span<const trees::Node> nodes = trees_.nodes();
  const bool self = rest_[pairs_[task].a].body == rest_[pairs_[task].b].body;
  Found found;
  std::size_t size = contacts.size();
  const auto test = [&](trees::NodePair pair) {
    const Range a = nodes[pair.a].slots(), b = nodes[pair.b].slots();
    if (contacts.size() < size + room) contacts.resize(size + 16 * room);
    const Index added = self ? patch_contacts_within(points_, a, b, tolerance2_, contacts.data() + size)
                             : patch_contacts_between(points_, a, b, tolerance2_, contacts.data() + size);
    found.self_contacts += self ? added : 0;
    found.pair_tests += std::uint64_t{a.size()} * b.size() - (pair.a == pair.b ? a.size() * (a.size() + 1) / 2 : 0);
    size += added;
    if (size > max_contacts) throw_too_many_contacts(max_contacts);
  };
  trees::for_leaf_pairs(
      nodes, pairs_[task], [&](trees::NodePair pair) { return apart(pair); }, test);
  contacts.resize(size);
  return found;
}

std::vector<DebugGeometry::Box> PatchSearch::boxes() const {
  std::vector<DebugGeometry::Box> boxes;
  for (std::size_t k = 0; k < which_.size(); ++k) {
    for (const trees::Node& node : trees_.nodes_of(k)) {
      if (node.is_leaf()) boxes.push_back({node.box.lo, node.box.hi, which_[k]});
    }
  }
  return boxes;
}

}  // namespace collide::exact
