#include "app/ui/tour/example.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/compare/compare.h"
#include "app/compare/positions.h"
#include "app/session/window_work.h"
#include "collide/core/body_boxes.h"
#include "collide/methods.h"
#include "softbody/world/measures.h"

namespace app::ui {
namespace {

using collide::Contact;
using collide::Index;
using softbody::BodyId;

constexpr std::uint64_t max_pair_tests = 300'000'000;  // of the paper's method: more would keep the window waiting

float distance_of(const softbody::BodiesInMotion& world, const Contact& contact) {
  const collide::Frame frame = world.positions();
  return glm::distance(position(frame, contact.a), position(frame, contact.b));
}

struct Pair {
  BodyId a, b;  // a <= b
  auto operator<=>(const Pair&) const = default;
};

Pair pair_of(const softbody::BodiesInMotion& world, const Contact& contact) {
  const auto [a, b] = std::minmax({world.bodies().body_of(contact.a), world.bodies().body_of(contact.b)});
  return {a, b};
}

/// True if a solid stands between the eye and the middle of a pair's boxes.
bool is_occluded(const softbody::BodiesInMotion& world, const collide::BodyBoxes& boxes, const Pair& pair,
                 const glm::dvec3& eye) {
  constexpr int samples = 64;
  const collide::Aabb &a = boxes.box[pair.a], &b = boxes.box[pair.b];
  const glm::dvec3 middle = 0.25 * (glm::dvec3(a.lo) + glm::dvec3(a.hi) + glm::dvec3(b.lo) + glm::dvec3(b.hi));
  for (int i = 0; i < samples; ++i)
    if (softbody::solid_depth(world.scene(), glm::mix(middle, eye, double(i) / samples)).depth > 0) return true;
  return false;
}

/// Returns the best example of a pair in contact. In this order it prefers a pair with the preferred body, in sight, of
/// two bodies, with both found and missed contacts, with missed contacts, with more contacts.
std::optional<Pair> best_pair(const softbody::BodiesInMotion& world, const collide::BodyBoxes& boxes,
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
                      std::min(missed_count, all - missed_count), missed_count, all);
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
  const auto distance = [&](BodyId candidate) {
    return candidate == body ? std::numeric_limits<float>::infinity() : gap(boxes.box[body], boxes.box[candidate]);
  };
  const BodyId nearest = *std::ranges::min_element(boxes.live, {}, distance);
  const BodyId other = std::isfinite(distance(nearest)) ? nearest : body;
  return Pair{std::min(body, other), std::max(body, other)};
}

collide::Result detect(collide::Detector& detector, const collide::Frame& frame, const collide::Settings& settings,
                       collide::Workers& workers) {
  collide::Result result;
  detector.forget();
  detector.detect(frame, settings, workers, result);
  return result;
}

std::vector<Contact> of_pair(const softbody::BodiesInMotion& world, std::vector<Contact> contacts, const Pair& pair) {
  std::erase_if(contacts, [&](const Contact& contact) { return pair_of(world, contact) != pair; });
  return contacts;
}

std::optional<Contact> closest_of(const softbody::BodiesInMotion& world, const std::vector<Contact>& contacts) {
  const auto closest =
      std::ranges::min_element(contacts, {}, [&](const Contact& contact) { return distance_of(world, contact); });
  return closest == contacts.end() ? std::nullopt : std::optional(*closest);
}

/// Returns the closest vertices of two different bodies, by doubling the tolerance until there are contacts.
std::optional<Contact> closest_between(const softbody::BodiesInMotion& world, const Pair& pair,
                                       collide::Detector& exact, collide::Workers& workers) {
  assert(pair.a < pair.b);
  const collide::Frame all = world.positions();
  compare::FrameCopy both;
  for (const BodyId body : {pair.a, pair.b}) both.add(all, body);
  collide::Settings settings = world.collision();
  settings.self_collision = false;
  constexpr int max_doublings = 20;
  for (int i = 0; i < max_doublings; ++i) {
    std::vector<Contact> near = detect(exact, both.view(), settings, workers).contacts;
    for (Contact& contact : near) {
      contact.a += all.bodies->first[pair.a];
      contact.b += all.bodies->first[pair.b] - both.bodies.first[1];
    }
    if (!near.empty()) return closest_of(world, near);
    settings.tolerance *= 2;
  }
  return std::nullopt;
}

std::array<HashedCorner, 8> hash_corners(const collide::DebugGeometry::Box& box,
                                         const collide::methods::CellHash& hash) {
  std::array<HashedCorner, 8> corners{};
  std::ranges::transform(compare::corners_of(box), corners.begin(),
                         [&](const glm::vec3& at) { return hash_corner(at, hash); });
  return corners;
}

/// Returns how far (m) the other cells of a corner's bucket are from its own cell at most; infinity if there are none.
float reach_of_aliases(const TourExample& example, const HashedCorner& corner, const glm::vec3& cell_size) {
  float reach = 0;
  for (const compare::CellGroup& group : example.table.bucket(corner.bucket).groups) {
    glm::vec3 offset;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      offset[axis] = static_cast<float>(group.cell[a] - corner.cell[a]) * cell_size[axis];
    }
    reach = std::max(reach, glm::length(offset));
  }
  return reach > 0 ? reach : std::numeric_limits<float>::infinity();
}

/// Returns the best corner for the tour. It prefers a bucket of several cells, then a cell with a box of another body.
std::size_t best_corner(const TourExample& example, const glm::vec3& cell_size) {
  const auto rank = [&](const HashedCorner& corner) {
    const compare::BucketContents bucket = example.table.bucket(corner.bucket);
    const bool shared = std::ranges::any_of(
        bucket.group(corner.cell)->items, [&](Index box) { return example.structure.boxes[box].body != example.body; });
    return std::pair(reach_of_aliases(example, corner, cell_size), !shared);
  };
  return static_cast<std::size_t>(std::ranges::min_element(example.corners, {}, rank) - example.corners.begin());
}

/// Returns the corner with the nearest aliases: of the boxes of the pair, or else of any box.
std::optional<HashedCorner> find_aliased_corner(const TourExample& example, const collide::Settings& settings) {
  if (example.table.sharing().aliased == 0) return std::nullopt;
  const collide::methods::CellHash hash(settings);
  const collide::Range of_other = boxes_of(example.structure, example.other);
  const collide::Range all{0, static_cast<Index>(example.structure.boxes.size())};
  std::optional<HashedCorner> best;
  float best_reach = std::numeric_limits<float>::infinity();
  const auto search = [&](const collide::Range& boxes) {
    for (Index box = boxes.begin; box < boxes.end; ++box)
      for (const HashedCorner& corner : hash_corners(example.structure.boxes[box], hash)) {
        const float reach = reach_of_aliases(example, corner, *settings.cell_size);
        if (reach >= best_reach) continue;
        best_reach = reach;
        best = corner;
      }
  };
  search(example.boxes);
  search(of_other);
  if (!best) search(all);
  return best;
}

/// Fills in the body's boxes and the corners of the box that is nearest to the other body.
void add_boxes(const softbody::BodiesInMotion& world, TourExample& example) {
  const collide::Settings& settings = world.collision();
  const collide::methods::CellHash hash(settings);
  example.boxes = boxes_of(example.structure, example.body);
  const Index nearest = example.closest ? example.closest->a : world.bodies().first[example.body];
  example.box = box_of(example.structure, example.body, position(world.positions(), nearest));
  example.corners = hash_corners(example.structure.boxes[example.box], hash);
  example.corner = best_corner(example, *settings.cell_size);
  if (std::isinf(reach_of_aliases(example, example.corners[example.corner], *settings.cell_size)))
    example.aliased_corner = find_aliased_corner(example, settings);
}

}  // namespace

ExampleFinder::ExampleFinder()
    : exact_(collide::find_method(collide::default_method)->make()),
      paper_(collide::find_method(collide::paper_method)->make()) {}

std::vector<Contact> ExampleFinder::true_contacts(const softbody::BodiesInMotion& world) {
  return detect(*exact_, world.positions(), world.collision(), one_worker_).contacts;
}

bool ExampleFinder::has_contact(const softbody::BodiesInMotion& world) { return !true_contacts(world).empty(); }

bool ExampleFinder::has_miss(const softbody::BodiesInMotion& world) {
  const std::vector<Contact> contacts = true_contacts(world);
  const collide::Frame frame = world.positions();
  return !contacts.empty() &&
         !missed_contacts(paper_structure_(frame, world.collision(), one_worker_), frame, contacts).empty();
}

std::optional<TourExample> ExampleFinder::find(const softbody::BodiesInMotion& world, std::optional<BodyId> preferred,
                                               std::optional<glm::dvec3> eye) {
  const collide::Frame frame = world.positions();
  const collide::Settings& settings = world.collision();
  collide::BodyBoxes boxes;
  collide::Result unused;
  boxes.build(frame, unused);

  TourExample example;
  example.structure = paper_structure_(frame, settings, one_worker_);
  const std::vector<Contact> contacts = true_contacts(world);
  const std::vector<Contact> missed = missed_contacts(example.structure, frame, contacts);
  example.all_contacts = contacts.size();
  example.all_missed = missed.size();
  const auto in_contact = best_pair(world, boxes, contacts, missed, preferred, eye);
  const auto pair = in_contact ? in_contact : nearest_pair(boxes, preferred);
  if (!pair) return std::nullopt;
  example.body = pair->a;
  example.other = pair->b;
  example.touching = in_contact.has_value();
  example.bounds = {boxes.box[example.body], boxes.box[example.other]};
  example.contacts = of_pair(world, contacts, *pair);
  example.missed = of_pair(world, missed, *pair);
  example.closest = example.touching                ? closest_of(world, example.contacts)
                    : example.body != example.other ? closest_between(world, *pair, *exact_, one_worker_)
                                                    : std::nullopt;
  if (example.closest) example.distance = distance_of(world, *example.closest);
  if (!missed.empty()) {
    const Pair of_miss = example.missed.empty() ? *best_pair(world, boxes, missed, missed, preferred, eye) : *pair;
    example.miss = explain_miss(*closest_of(world, of_pair(world, missed, of_miss)), example.structure, frame,
                                collide::methods::CellHash(settings));
  }
  example.table = compare::TableContents(example.structure, frame, settings);
  add_boxes(world, example);
  example.work = count_work(world, example.structure.boxes.size());
  return example;
}

FrameWork ExampleFinder::count_work(const softbody::BodiesInMotion& world, std::size_t boxes) {
  const collide::Method& paper = *collide::find_method(collide::paper_method);
  const std::uint64_t estimate = session::window_work(world, paper, world.collision()).pair_tests;
  FrameWork work{.bodies = world.bodies().count(),
                 .vertices = world.bodies().vertex_count(),
                 .boxes = boxes,
                 .hashes = 8 * boxes,
                 .pair_tests = estimate,
                 .all_pairs = compare::all_pair_tests(world.bodies(), world.collision().self_collision),
                 .pair_tests_estimated = estimate > max_pair_tests};
  if (!work.pair_tests_estimated)
    work.pair_tests = detect(*paper_, world.positions(), world.collision(), one_worker_).counters.pair_tests;
  return work;
}

}  // namespace app::ui
