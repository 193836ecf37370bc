#include "collide/exact/patch_search.h"

#include <cassert>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "collide/core/vertex_run.h"

namespace collide::exact {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::array<float, 4> padded(const glm::vec3& p) { return {p.x, p.y, p.z, 0}; }

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
  const std::span<const trees::Node> nodes = trees_.nodes();
  for (std::size_t at = trees_.root(0); at < nodes.size(); ++at) {
    boxes_[at].lo = padded(nodes[at].box.lo);
    boxes_[at].hi = padded(nodes[at].box.hi);
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
  take_rest_boxes();
}

void PatchSearch::take_rest_boxes() {
  const std::span<const trees::Node> nodes = trees_.nodes();
  boxes_.resize(nodes.size());
  body_.resize(nodes.size());
  for (std::size_t at = nodes.size(); at-- > trees_.root(0);) {
    const trees::Node& node = nodes[at];
    PatchBoxes& boxes = boxes_[at];
    boxes.rest_lo = padded(glm::vec3(infinity));
    boxes.rest_hi = padded(glm::vec3(-infinity));
    const auto add = [&boxes](std::size_t axis, float lo, float hi) {
      boxes.rest_lo[axis] = std::min(boxes.rest_lo[axis], std::isnan(lo) ? -infinity : lo);
      boxes.rest_hi[axis] = std::max(boxes.rest_hi[axis], std::isnan(hi) ? infinity : hi);
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<float>& rest = axis == 0 ? points_.rest_x : axis == 1 ? points_.rest_y : points_.rest_z;
      for (Index k = node.first; k < node.first + (node.is_leaf() ? node.size : node.children); ++k) {
        if (node.is_leaf()) {
          add(axis, rest[k], rest[k]);
        } else {
          add(axis, boxes_[k].rest_lo[axis], boxes_[k].rest_hi[axis]);
        }
      }
    }
    body_[at] = node.is_leaf() ? points_.now->body[node.first] : body_[node.first];
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
  const PatchBoxes &a = boxes_[pair.a], &b = boxes_[pair.b];
  if (body_[pair.a] == body_[pair.b] && greatest_squared_rest_distance(a, b) < tolerance2_) return true;
  return least_squared_distance(a, b) >= tolerance2_;
}

PatchSearch::Found PatchSearch::find(std::size_t task, std::size_t max_contacts, std::vector<Contact>& contacts) const {
  constexpr std::size_t room = std::size_t{trees::BodyTrees::patch_size} * trees::BodyTrees::patch_size;
  const std::span<const trees::Node> nodes = trees_.nodes();
  const bool self = body_[pairs_[task].a] == body_[pairs_[task].b];
  Found found;
  std::size_t size = contacts.size();
  const auto test = [&](trees::NodePair pair) {
    const Range a = nodes[pair.a].slots(), b = nodes[pair.b].slots();
    if (contacts.size() < size + room) contacts.resize(size + 16 * room);
    const PatchBoxes& box = boxes_[pair.b];
    const Index added = self ? patch_contacts_within(points_, a, b, box, tolerance2_, contacts.data() + size)
                             : patch_contacts_between(points_, a, b, box, tolerance2_, contacts.data() + size);
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
