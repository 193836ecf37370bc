#include "collide/exact/patch_search.h"

#include <algorithm>
#include <utility>

namespace collide::exact {

void PatchSearch::begin(float tolerance2, float cutoff) {
  tolerance2_ = tolerance2;
  if (cutoff != cutoff_) unit_ = ByteUnit(cutoff);
  cutoff_ = cutoff;
  bodies_.clear();
  tasks_.clear();
  std::erase_if(cuts_, [](const auto& item) { return !item.second.shape(); });
}

std::size_t PatchSearch::take(const Frame& frame, std::span<const std::array<Index, 2>> pairs, int threads,
                              Workers& workers) {
  std::vector<Index> which;
  for (const auto& pair : pairs) which.insert(which.end(), pair.begin(), pair.end());
  std::ranges::sort(which);
  which.erase(std::unique(which.begin(), which.end()), which.end());
  Index groups = 0;
  for (const Index body : which) {
    bodies_.push_back(lay_out(frame, body, groups, false));
    groups = bodies_.back().groups().end;
  }
  patches_.resize(groups);
  fill(frame, workers);
  if (cut_spread_shapes(frame)) {
    fill(frame, workers);
    for (const Body& body : bodies_)
      body.cut->spread = std::max(body.cut->spread, spread_of(patches_.patch, body.patches()));
  }
  const Index groups_a_task = threads == 1 ? groups : 8;
  const auto find = [&](Index body) { return &*std::ranges::lower_bound(bodies_, body, {}, &Body::body); };
  for (const auto& pair : pairs) {
    const Body *a = find(pair[0]), *b = find(pair[1]);
    if (a == b) a->cut->list_pairs(tolerance2_, cutoff_);
    if (b->cut->groups() < a->cut->groups()) std::swap(a, b);  // each group of a looks at all of b
    const Index end = a->groups().end;
    for (Index begin = a->groups().begin; begin < end; begin += groups_a_task)
      tasks_.push_back({a, b, {begin, std::min(end, begin + groups_a_task)}});
  }
  return tasks_.size();
}

/// Cuts a shape that is new. self: whether pairs inside the body are to be found.
PatchSearch::Body PatchSearch::lay_out(const Frame& frame, Index body, Index first_group, bool self) {
  const std::shared_ptr<const Shape>& shape = frame.bodies->shape[body];
  const std::lock_guard lock(mutex_);
  PatchedShape& cut = cuts_.try_emplace(shape.get(), shape, vertices_of(frame, body)).first->second;
  if (self) cut.list_pairs(tolerance2_, cutoff_);
  return {&cut, shape.get(), body, frame.bodies->first[body], first_group};
}

void PatchSearch::fill(const Frame& frame, Workers& workers) {
  constexpr double group_ns = 2 * Patches::group_size;  // of work
  const std::size_t groups = bodies_.back().groups().end;
  const int parts = workers.threads_for(group_ns * static_cast<double>(groups));
  workers.run(parts, [&](int number) {
    const Part part = part_of(groups, number, parts);
    for (const Body& body : bodies_) {
      const Range all = body.groups();
      const Index begin = std::max(all.begin, static_cast<Index>(part.begin));
      const Index end = std::min(all.end, static_cast<Index>(part.end));
      if (begin < end) fill(frame, body, {begin - all.begin, end - all.begin}, patches_);
    }
  });
}

void PatchSearch::fill(const Frame& frame, const Body& body, Range groups, Patches& patches) const {
  fill_groups(vertices_of(frame, body.body), body.cut->vertices().data(), groups, body.first_group, unit_, patches);
}

/// Cuts shapes anew whose vertices have mixed: in some body their patches have grown to more than twice their size.
bool PatchSearch::cut_spread_shapes(const Frame& frame) {
  bool any = false;
  for (const Body& body : bodies_) {
    if (!(spread_of(patches_.patch, body.patches()) > 2 * body.cut->spread)) continue;
    body.cut->cut(vertices_of(frame, body.body));
    any = true;
  }
  return any;
}

void PatchSearch::forget() {
  bodies_.clear();
  std::erase_if(cuts_, [](const auto& item) { return !item.second.is_of_rest(); });
}

PatchSearch::Found PatchSearch::find(std::size_t task, std::size_t max_contacts, Scratch& scratch,
                                     std::vector<Contact>& contacts) const {
  return find(tasks_[task], patches_, max_contacts, scratch.hits, contacts);
}

PatchSearch::Found PatchSearch::find(const Frame& frame, Index a, Index b, std::size_t max_contacts, Scratch& scratch,
                                     std::vector<Contact>& contacts) {
  const Body one = lay_out(frame, a, 0, a == b), two = a == b ? one : lay_out(frame, b, one.groups().end, false);
  if (scratch.patches.count.size() < two.groups().end) scratch.patches.resize(two.groups().end);
  fill(frame, one, {0, one.cut->groups()}, scratch.patches);
  add_boxes(one, scratch.patches, scratch.boxes);
  if (a == b) return find({&one, &one, one.groups()}, scratch.patches, max_contacts, scratch.hits, contacts);
  fill(frame, two, {0, two.cut->groups()}, scratch.patches);
  add_boxes(two, scratch.patches, scratch.boxes);
  return find({&one, &two, one.groups()}, scratch.patches, max_contacts, scratch.hits, contacts);
}

PatchSearch::Found PatchSearch::find(const Task& task, const Patches& patches, std::size_t max_contacts,
                                     GroupHits& hits, std::vector<Contact>& contacts) const {
  const bool self = task.a == task.b;
  const KnownPairs* const known = self ? &task.a->cut->known() : nullptr;
  const Index offset = task.a->first_group;
  Found found;
  const std::size_t before = contacts.size();
  for (Index group = task.groups.begin; group < task.groups.end; ++group) {
    const Range others{self ? group : task.b->groups().begin, task.b->groups().end};
    list_near_groups(patches, group, others, known, offset, cutoff_, hits);
    find_group_hits(patches, group, known, offset, cutoff_, tolerance2_, hits);
    found.pair_tests += hits.tested;
    add_contacts(task, hits.known, true, contacts);
    add_contacts(task, hits.found, false, contacts);
    if (contacts.size() > max_contacts) throw_too_many_contacts(max_contacts);
  }
  if (self) found.self_contacts = contacts.size() - before;
  return found;
}

/// known: the shape has nothing more to say of these pairs.
void PatchSearch::add_contacts(const Task& task, std::span<const std::array<Index, 2>> pairs, bool known,
                               std::vector<Contact>& contacts) const {
  const Body &a = *task.a, &b = *task.b;
  for (const auto& [place_a, place_b] : pairs) {
    const Index one = a.cut->vertices()[place_a - a.first_group * Patches::group_size];
    const Index other = b.cut->vertices()[place_b - b.first_group * Patches::group_size];
    if (!known && &a == &b && a.shape->excludes(one, other, tolerance2_)) continue;
    const Index first = a.first_vertex + one, second = b.first_vertex + other;
    contacts.push_back({std::min(first, second), std::max(first, second)});
  }
}

std::size_t PatchSearch::patches() const {
  std::size_t sum = 0;
  for (const Body& body : bodies_) sum += body.cut->patches();
  return sum;
}

void PatchSearch::add_boxes(std::vector<DebugGeometry::Box>& boxes) const {
  for (const Body& body : bodies_) add_boxes(body, patches_, boxes);
}

void PatchSearch::add_boxes(const Body& body, const Patches& patches, std::vector<DebugGeometry::Box>& boxes) {
  const auto& [lo, hi] = patches.patch;
  for (Index p = body.patches().begin; p < body.patches().end; ++p)
    boxes.push_back({{lo[0][p], lo[1][p], lo[2][p]}, {hi[0][p], hi[1][p], hi[2][p]}, body.body});
}

}  // namespace collide::exact
