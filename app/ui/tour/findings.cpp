#include "app/ui/tour/findings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/compare/cost_model.h"
#include "app/compare/score.h"
#include "app/ui/tour/excerpt.h"
#include "collide/core/body_boxes.h"
#include "collide/methods/detectors.h"
#include "softbody/measures.h"

namespace app {
namespace {

using collide::Contact;
using collide::Index;
using softbody::BodyId;

constexpr std::uint64_t most_tests = 300'000'000;  // of the paper's method, so that the window does not wait for long

glm::vec3 vertex(const softbody::World& world, Index v) {
  const collide::Frame f = world.positions();
  return {f.x[v], f.y[v], f.z[v]};
}

float distance_of(const softbody::World& world, const Contact& contact) {
  return glm::distance(vertex(world, contact.a), vertex(world, contact.b));
}

struct Pair {
  BodyId a, b;  // a <= b
  auto operator<=>(const Pair&) const = default;
};

Pair pair_of(const softbody::World& world, const Contact& contact) {
  const auto body = world.vertex_body();
  const auto [a, b] = std::minmax(body[contact.a], body[contact.b]);
  return {a, b};
}

/// Whether a solid stands between the eye and the middle of a pair's boxes.
bool hidden(const softbody::World& world, const collide::BodyBoxes& boxes, const Pair& pair, const glm::dvec3& eye) {
  constexpr int places = 64;
  const collide::Aabb &a = boxes.box[pair.a], &b = boxes.box[pair.b];
  const glm::dvec3 middle = 0.25 * (glm::dvec3(a.lo) + glm::dvec3(a.hi) + glm::dvec3(b.lo) + glm::dvec3(b.hi));
  for (int i = 0; i < places; ++i)
    if (softbody::solid_depth(world.scene(), glm::mix(middle, eye, double(i) / places)).depth > 0) return true;
  return false;
}

/// The most telling pair in contact: with the wished body, in sight, of two bodies, with found and missed contacts,
/// with most.
std::optional<Pair> most_telling(const softbody::World& world, const collide::BodyBoxes& boxes,
                                 const std::vector<Contact>& contacts, const std::vector<Contact>& missed,
                                 std::optional<BodyId> wish, std::optional<glm::dvec3> eye) {
  std::map<Pair, std::pair<std::size_t, std::size_t>> counts;  // missed, all
  for (const Contact& contact : contacts) ++counts[pair_of(world, contact)].second;
  for (const Contact& contact : missed) ++counts[pair_of(world, contact)].first;
  const auto rank = [&](const auto& entry) {
    const auto& [pair, count] = entry;
    const auto [lost, all] = count;
    return std::tuple(wish && (pair.a == *wish || pair.b == *wish), !eye || !hidden(world, boxes, pair, *eye),
                      pair.a != pair.b, std::min(lost, all - lost), all);
  };
  using Rank = decltype(rank(*counts.begin()));
  std::optional<std::pair<Rank, Pair>> best;  // each is ranked once: it looks along the line of sight
  for (const auto& entry : counts)
    if (const Rank now = rank(entry); !best || now > best->first) best.emplace(now, entry.first);
  return best ? std::optional(best->second) : std::nullopt;
}

float gap(const collide::Aabb& a, const collide::Aabb& b) {
  return glm::length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), glm::vec3(0.0f)));
}

/// Where nothing touches: the wished body, or the first, and the one whose box is nearest to its own.
std::optional<Pair> nearest(const collide::BodyBoxes& boxes, std::optional<BodyId> wish) {
  if (boxes.live.empty()) return std::nullopt;
  const bool granted = wish && std::ranges::count(boxes.live, *wish) > 0;
  const BodyId body = granted ? *wish : boxes.live.front();
  BodyId other = body;
  float least = std::numeric_limits<float>::infinity();
  for (const BodyId candidate : boxes.live) {
    const float away = gap(boxes.box[body], boxes.box[candidate]);
    if (candidate == body || away >= least) continue;
    least = away;
    other = candidate;
  }
  return Pair{std::min(body, other), std::max(body, other)};
}

std::vector<Contact> detect(collide::Detector& detector, const collide::Frame& frame, const collide::Settings& settings,
                            collide::Workers& workers, collide::Counters* counters = nullptr) {
  collide::Result result;
  detector.forget();
  detector.detect(frame, settings, workers, result);
  if (counters) *counters = result.counters;
  return std::move(result.contacts);
}

std::optional<Contact> closest_of(const softbody::World& world, const std::vector<Contact>& contacts) {
  const auto least =
      std::ranges::min_element(contacts, {}, [&](const Contact& contact) { return distance_of(world, contact); });
  return least == contacts.end() ? std::nullopt : std::optional(*least);
}

/// The two vertices of different bodies that are nearest: found with an ever greater tolerance.
std::optional<Contact> closest_apart(const softbody::World& world, const Pair& pair, collide::Detector& exact,
                                     collide::Workers& workers) {
  const Excerpt excerpt(world, pair.a, pair.b);
  collide::Settings settings = world.collision();
  settings.self_collision = false;
  for (int i = 0; i < 20; ++i) {
    std::vector<Contact> near = detect(exact, excerpt.frame(), settings, workers);
    for (Contact& contact : near) contact = excerpt.in_world(contact);
    if (!near.empty()) return closest_of(world, near);
    settings.tolerance *= 2;
  }
  return std::nullopt;
}

/// The body's box that a vertex of it is in: on a cut, the upper one (§2.1).
Index box_of(const Findings& f, const glm::vec3& at) {
  Index box = f.boxes.front();
  glm::vec3 least(-std::numeric_limits<float>::infinity());
  for (const Index i : f.boxes) {
    const auto& [lo, hi, body] = f.structure.boxes[i];
    const bool holds = glm::max(lo, at) == at && glm::min(hi, at) == at;
    if (!holds || glm::max(lo, least) != lo) continue;
    least = lo;
    box = i;
  }
  return box;
}

std::array<HashedCorner, 8> hashed(const collide::DebugGeometry::Box& box, const collide::methods::CellHash& hash) {
  std::array<HashedCorner, 8> corners{};
  const auto points = corners_of(box);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Cell cell = hash.cell(points[i].x, points[i].y, points[i].z);
    corners[i] = {points[i], cell, hash.bucket(cell)};
  }
  return corners;
}

/// A corner in a cell with boxes of the other body, or else in a bucket with others at all.
std::size_t telling_corner(const Findings& f) {
  std::size_t best = 0;
  int most = -1;
  for (std::size_t i = 0; i < f.corners.size(); ++i) {
    const BucketContents bucket = f.table.bucket(f.corners[i].bucket);
    const CellGroup* group = bucket.group(f.corners[i].cell);
    const auto of_other = [&](Index box) { return f.structure.boxes[box].body != f.body; };
    const int meets = group && std::ranges::any_of(group->items, of_other) ? 2 : 0;
    const int score = meets + (bucket.groups.size() > 1 ? 1 : 0);
    if (score <= most) continue;
    most = score;
    best = i;
  }
  return best;
}

/// Boxes, table and the corners of the box that is nearest to the other body.
void look_at_structure(const softbody::World& world, Findings& f) {
  const collide::methods::CellHash hash(world.collision());
  for (Index i = 0; i < f.structure.boxes.size(); ++i)
    if (f.structure.boxes[i].body == f.body) f.boxes.push_back(i);
  f.box = box_of(f, vertex(world, f.closest ? f.closest->a : world.bodies().first[f.body]));
  f.corners = hashed(f.structure.boxes[f.box], hash);
  f.corner = telling_corner(f);
}

std::uint64_t predicted_tests(const softbody::World& world, std::size_t method) {
  CostModel cost_model;
  cost_model.begin(world.positions(), world.collision(), 0);
  return cost_model.of(method).pair_tests;
}

std::size_t paper_index() {
  return static_cast<std::size_t>(collide::find_method(collide::paper_method) - collide::method_table().data());
}

}  // namespace

Finder::Finder()
    : exact_(collide::find_method(collide::default_method)->make()),
      paper_(collide::find_method(collide::paper_method)->make()) {}

/// Of two bodies the paper's method finds the same whether there are others or not.
std::optional<std::vector<Contact>> Finder::missed_by_themselves(const softbody::World& world, const Findings& f) {
  const Excerpt excerpt(world, f.body, f.other);
  if (all_pair_tests(*excerpt.frame().bodies, world.collision().self_collision) > most_tests) return std::nullopt;
  std::vector<Contact> found = detect(*paper_, excerpt.frame(), world.collision(), alone_);
  for (Contact& contact : found) contact = excerpt.in_world(contact);
  return score(found, f.contacts).missed;
}

std::optional<Findings> Finder::find(const softbody::World& world, std::optional<BodyId> wish,
                                     std::optional<glm::dvec3> eye) {
  const collide::Frame frame = world.positions();
  const collide::Settings& settings = world.collision();
  collide::BodyBoxes boxes;
  collide::Result unused;
  boxes.build(frame, unused);

  Findings f;
  const std::vector<Contact> truth = detect(*exact_, frame, settings, alone_);
  std::vector<Contact> missed;
  const std::uint64_t tests = predicted_tests(world, paper_index());
  f.predicted_tests = tests > most_tests;
  if (f.predicted_tests) {
    f.structure = collide::methods::make_paper_structure()(frame, settings, alone_);
    f.work = {.hashes = 8 * f.structure.boxes.size(), .boxes = f.structure.boxes.size(), .pair_tests = tests};
  } else {
    missed = score(detect(*paper_, frame, settings, alone_, &f.work), truth).missed;
    f.structure = paper_->debug();
  }
  const auto in_touch = most_telling(world, boxes, truth, missed, wish, eye);
  const auto pair = in_touch ? in_touch : nearest(boxes, wish);
  if (!pair) return std::nullopt;
  f.body = pair->a;
  f.other = pair->b;
  f.touching = in_touch.has_value();
  f.bounds = {boxes.box[f.body], boxes.box[f.other]};
  const auto is_of_pair = [&](const Contact& contact) { return pair_of(world, contact) == *pair; };
  std::ranges::copy_if(truth, std::back_inserter(f.contacts), is_of_pair);
  if (!f.predicted_tests) {
    f.missed.emplace();
    std::ranges::copy_if(missed, std::back_inserter(*f.missed), is_of_pair);
  } else if (f.touching) {
    f.missed = missed_by_themselves(world, f);
  }
  f.closest = f.touching          ? closest_of(world, f.contacts)
              : f.body != f.other ? closest_apart(world, *pair, *exact_, alone_)
                                  : std::nullopt;
  if (f.closest) f.distance = distance_of(world, *f.closest);
  f.table = TableContents(f.structure, frame, settings);
  look_at_structure(world, f);
  return f;
}

}  // namespace app
