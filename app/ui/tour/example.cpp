#include "app/ui/tour/example.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/compare/compare.h"
#include "app/compare/cost_model.h"
#include "app/compare/score.h"
#include "app/ui/tour/body_subset.h"
#include "collide/core/body_boxes.h"
#include "collide/methods/detectors.h"
#include "softbody/measures.h"

namespace app::ui {
namespace {

using collide::Contact;
using collide::Index;
using softbody::BodyId;

constexpr std::uint64_t max_pair_tests = 300'000'000;  // of the paper's method: more would keep the window waiting

glm::vec3 vertex(const softbody::World& world, Index v) {
  const collide::Frame frame = world.positions();
  return {frame.x[v], frame.y[v], frame.z[v]};
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

/// True if a solid stands between the eye and the middle of a pair's boxes.
bool is_occluded(const softbody::World& world, const collide::BodyBoxes& boxes, const Pair& pair,
                 const glm::dvec3& eye) {
  constexpr int samples = 64;
  const collide::Aabb &a = boxes.box[pair.a], &b = boxes.box[pair.b];
  const glm::dvec3 middle = 0.25 * (glm::dvec3(a.lo) + glm::dvec3(a.hi) + glm::dvec3(b.lo) + glm::dvec3(b.hi));
  for (int i = 0; i < samples; ++i)
    if (softbody::solid_depth(world.scene(), glm::mix(middle, eye, double(i) / samples)).depth > 0) return true;
  return false;
}

/// Returns the best example of a pair in contact. In this order it prefers a pair with the preferred body, in sight, of
/// two bodies, with both found and missed contacts, with more contacts.
std::optional<Pair> best_pair(const softbody::World& world, const collide::BodyBoxes& boxes,
                              const std::vector<Contact>& contacts, const std::vector<Contact>& missed,
                              std::optional<BodyId> preferred, std::optional<glm::dvec3> eye) {
  std::map<Pair, std::pair<std::size_t, std::size_t>> counts;  // missed, all
  for (const Contact& contact : contacts) ++counts[pair_of(world, contact)].second;
  for (const Contact& contact : missed) ++counts[pair_of(world, contact)].first;
  const auto rank = [&](const auto& entry) {
    const auto& [pair, count] = entry;
    const auto [missed_count, all] = count;
    return std::tuple(preferred && (pair.a == *preferred || pair.b == *preferred),
                      !eye || !is_occluded(world, boxes, pair, *eye), pair.a != pair.b,
                      std::min(missed_count, all - missed_count), all);
  };
  using Rank = decltype(rank(*counts.begin()));
  std::optional<std::pair<Rank, Pair>> best;  // each pair is ranked once, as the test for occlusion is slow
  for (const auto& entry : counts)
    if (const Rank now = rank(entry); !best || now > best->first) best.emplace(now, entry.first);
  return best ? std::optional(best->second) : std::nullopt;
}

float gap(const collide::Aabb& a, const collide::Aabb& b) {
  return glm::length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), glm::vec3(0.0f)));
}

/// Returns the preferred body, or the first, and the body whose box is nearest to its own.
std::optional<Pair> nearest_pair(const collide::BodyBoxes& boxes, std::optional<BodyId> preferred) {
  if (boxes.live.empty()) return std::nullopt;
  const bool exists = preferred && std::ranges::count(boxes.live, *preferred) > 0;
  const BodyId body = exists ? *preferred : boxes.live.front();
  BodyId other = body;
  float min_gap = std::numeric_limits<float>::infinity();
  for (const BodyId candidate : boxes.live) {
    const float distance = gap(boxes.box[body], boxes.box[candidate]);
    if (candidate == body || distance >= min_gap) continue;
    min_gap = distance;
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
  const auto closest =
      std::ranges::min_element(contacts, {}, [&](const Contact& contact) { return distance_of(world, contact); });
  return closest == contacts.end() ? std::nullopt : std::optional(*closest);
}

/// Returns the closest vertices of two different bodies, by doubling the tolerance until there are contacts.
std::optional<Contact> closest_between(const softbody::World& world, const Pair& pair, collide::Detector& exact,
                                       collide::Workers& workers) {
  const BodySubset subset(world, pair.a, pair.b);
  collide::Settings settings = world.collision();
  settings.self_collision = false;
  constexpr int max_doublings = 20;
  for (int i = 0; i < max_doublings; ++i) {
    std::vector<Contact> near = detect(exact, subset.frame(), settings, workers);
    for (Contact& contact : near) contact = subset.to_world(contact);
    if (!near.empty()) return closest_of(world, near);
    settings.tolerance *= 2;
  }
  return std::nullopt;
}

/// Returns the box of the body that holds one of its vertices: the upper box if the vertex is on a cut (§2.1).
Index box_of(const TourExample& example, const glm::vec3& at) {
  Index box = example.boxes.front();
  glm::vec3 lower(-std::numeric_limits<float>::infinity());
  for (const Index i : example.boxes) {
    const auto& [lo, hi, body] = example.structure.boxes[i];
    const bool holds = glm::max(lo, at) == at && glm::min(hi, at) == at;
    if (!holds || glm::max(lo, lower) != lo) continue;
    lower = lo;
    box = i;
  }
  return box;
}

std::array<HashedCorner, 8> hash_corners(const collide::DebugGeometry::Box& box,
                                         const collide::methods::CellHash& hash) {
  std::array<HashedCorner, 8> corners{};
  const auto points = compare::corners_of(box);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const compare::Cell cell = hash.cell(points[i].x, points[i].y, points[i].z);
    corners[i] = {points[i], cell, hash.bucket(cell)};
  }
  return corners;
}

/// Returns the best corner for the tour. It prefers a cell with a box of another body, then a bucket of several cells.
std::size_t best_corner(const TourExample& example) {
  std::size_t best = 0;
  int best_score = -1;
  for (std::size_t i = 0; i < example.corners.size(); ++i) {
    const compare::BucketContents bucket = example.table.bucket(example.corners[i].bucket);
    const compare::CellGroup* group = bucket.group(example.corners[i].cell);
    const auto of_other = [&](Index box) { return example.structure.boxes[box].body != example.body; };
    const int shares_cell = group && std::ranges::any_of(group->items, of_other) ? 2 : 0;
    const int score = shares_cell + (bucket.groups.size() > 1 ? 1 : 0);
    if (score <= best_score) continue;
    best_score = score;
    best = i;
  }
  return best;
}

/// Fills in the body's boxes and the corners of the box that is nearest to the other body.
void add_boxes(const softbody::World& world, TourExample& example) {
  const collide::methods::CellHash hash(world.collision());
  for (Index i = 0; i < example.structure.boxes.size(); ++i)
    if (example.structure.boxes[i].body == example.body) example.boxes.push_back(i);
  example.box =
      box_of(example, vertex(world, example.closest ? example.closest->a : world.bodies().first[example.body]));
  example.corners = hash_corners(example.structure.boxes[example.box], hash);
  example.corner = best_corner(example);
}

std::uint64_t estimate_pair_tests(const softbody::World& world, std::size_t method) {
  compare::CostModel cost_model;
  cost_model.begin(world.positions(), world.collision(), 0);
  return cost_model.of(method).pair_tests;
}

std::size_t paper_index() { return compare::method_index(collide::paper_method); }

}  // namespace

ExampleFinder::ExampleFinder()
    : exact_(collide::find_method(collide::default_method)->make()),
      paper_(collide::find_method(collide::paper_method)->make()) {}

/// The paper's method finds the same contacts of two bodies whether there are other bodies or not.
std::optional<std::vector<Contact>> ExampleFinder::missed_of_pair(const softbody::World& world,
                                                                  const TourExample& example) {
  const BodySubset subset(world, example.body, example.other);
  if (compare::all_pair_tests(*subset.frame().bodies, world.collision().self_collision) > max_pair_tests)
    return std::nullopt;
  std::vector<Contact> found = detect(*paper_, subset.frame(), world.collision(), one_worker_);
  for (Contact& contact : found) contact = subset.to_world(contact);
  return compare::score(found, example.contacts).missed;
}

std::optional<TourExample> ExampleFinder::find(const softbody::World& world, std::optional<BodyId> preferred,
                                               std::optional<glm::dvec3> eye) {
  const collide::Frame frame = world.positions();
  const collide::Settings& settings = world.collision();
  collide::BodyBoxes boxes;
  collide::Result unused;
  boxes.build(frame, unused);

  TourExample example;
  const std::vector<Contact> true_contacts = detect(*exact_, frame, settings, one_worker_);
  std::vector<Contact> missed;
  const std::uint64_t tests = estimate_pair_tests(world, paper_index());
  example.pair_tests_estimated = tests > max_pair_tests;
  if (example.pair_tests_estimated) {
    example.structure = collide::methods::make_paper_structure()(frame, settings, one_worker_);
    example.work = {
        .hashes = 8 * example.structure.boxes.size(), .boxes = example.structure.boxes.size(), .pair_tests = tests};
  } else {
    missed = compare::score(detect(*paper_, frame, settings, one_worker_, &example.work), true_contacts).missed;
    example.structure = paper_->debug();
  }
  const auto in_contact = best_pair(world, boxes, true_contacts, missed, preferred, eye);
  const auto pair = in_contact ? in_contact : nearest_pair(boxes, preferred);
  if (!pair) return std::nullopt;
  example.body = pair->a;
  example.other = pair->b;
  example.touching = in_contact.has_value();
  example.bounds = {boxes.box[example.body], boxes.box[example.other]};
  const auto is_of_pair = [&](const Contact& contact) { return pair_of(world, contact) == *pair; };
  std::ranges::copy_if(true_contacts, std::back_inserter(example.contacts), is_of_pair);
  if (!example.pair_tests_estimated) {
    example.missed.emplace();
    std::ranges::copy_if(missed, std::back_inserter(*example.missed), is_of_pair);
  } else if (example.touching) {
    example.missed = missed_of_pair(world, example);
  }
  example.closest = example.touching                ? closest_of(world, example.contacts)
                    : example.body != example.other ? closest_between(world, *pair, *exact_, one_worker_)
                                                    : std::nullopt;
  if (example.closest) example.distance = distance_of(world, *example.closest);
  example.table = compare::TableContents(example.structure, frame, settings);
  add_boxes(world, example);
  return example;
}

}  // namespace app::ui
