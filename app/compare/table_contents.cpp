#include "app/compare/table_contents.h"

#include <algorithm>
#include <cassert>
#include <span>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/compare/cost_model.h"

namespace app::compare {
namespace {

/// Returns the number of pairs within runs of equal values, summed over all runs.
template <class Range, class Same>
std::uint64_t pairs_in_runs(const Range& range, const Same& same) {
  std::uint64_t pairs = 0;
  for (auto first = range.begin(); first != range.end();) {
    const auto end = std::find_if_not(first, range.end(), [&](const auto& other) { return same(*first, other); });
    pairs += pairs_of(static_cast<std::uint64_t>(end - first));
    first = end;
  }
  return pairs;
}

/// Counts the shared cells and the aliasing among the entries of one bucket.
Sharing sharing_in(std::span<const TableEntry> entries) {
  std::vector<collide::Index> items;
  for (const TableEntry& entry : entries) items.push_back(entry.item);
  std::ranges::sort(items);
  const std::uint64_t same = pairs_in_runs(entries, [](auto& a, auto& b) { return a.cell == b.cell; });
  const std::uint64_t with_itself = pairs_in_runs(items, std::equal_to<>());
  return {same, pairs_of(entries.size()) - same - with_itself};
}

}  // namespace

std::array<glm::vec3, 8> corners_of(const collide::DebugGeometry::Box& box) {
  std::array<glm::vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {i & 4 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y, i & 1 ? box.hi.z : box.lo.z};
  return corners;
}

const CellGroup* BucketContents::group(const std::optional<Cell>& cell) const {
  const auto found = std::ranges::find_if(groups, [&](const CellGroup& g) { return cell && g.cell == *cell; });
  if (found != groups.end()) return &*found;
  return groups.empty() ? nullptr : &groups.front();
}

TableContents::TableContents(const collide::DebugGeometry& debug, const collide::Frame& frame,
                             const collide::Settings& settings)
    : entries_are_vertices_(!debug.vertices.empty()) {
  assert(collide::is_complete(frame));
  const collide::methods::CellHash hash(settings);
  const auto add = [&](const Cell& cell, collide::Index item) { entries_.push_back({hash.bucket(cell), cell, item}); };
  for (const collide::Index v : debug.vertices) add(hash.cell(frame.x[v], frame.y[v], frame.z[v]), v);
  for (collide::Index box = 0; box < debug.boxes.size(); ++box)
    for (const glm::vec3& corner : corners_of(debug.boxes[box])) add(hash.cell(corner.x, corner.y, corner.z), box);
  std::ranges::sort(entries_);
  entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
  for (auto first = entries_.begin(); first != entries_.end();) {
    const auto end = std::ranges::find_if_not(first, entries_.end(),
                                              [&](const TableEntry& other) { return other.bucket == first->bucket; });
    const Sharing here = sharing_in({first, end});
    sharing_.same_cell += here.same_cell;
    sharing_.aliased += here.aliased;
    first = end;
  }
}

BucketContents TableContents::bucket(std::uint32_t number) const {
  const auto first = std::ranges::lower_bound(entries_, number, {}, &TableEntry::bucket);
  const std::span entries(first, std::ranges::upper_bound(first, entries_.end(), number, {}, &TableEntry::bucket));
  BucketContents contents{.bucket = number, .vertices = entries_are_vertices_};
  std::vector<collide::Index> items;
  for (const TableEntry& entry : entries) {
    if (contents.groups.empty() || contents.groups.back().cell != entry.cell)
      contents.groups.push_back({entry.cell, {}});
    contents.groups.back().items.push_back(entry.item);
    items.push_back(entry.item);
  }
  std::ranges::stable_sort(contents.groups, std::greater<>(), [](const CellGroup& g) { return g.items.size(); });
  std::ranges::sort(items);
  contents.items = static_cast<std::size_t>(std::unique(items.begin(), items.end()) - items.begin());
  contents.sharing = sharing_in(entries);
  return contents;
}

std::string cell_text(const Cell& cell) { return fmt::format("({}, {}, {})", cell[0], cell[1], cell[2]); }

std::string sharing_text(const Sharing& sharing) {
  return fmt::format("{} near, {} by chance", grouped(sharing.same_cell), grouped(sharing.aliased));
}

std::string bodies_text(const CellGroup& group, const BucketContents& bucket, const collide::DebugGeometry& debug,
                        const collide::Bodies& of_world) {
  constexpr std::size_t max_named = 3;
  std::vector<collide::Index> bodies;
  for (const collide::Index item : group.items)
    bodies.push_back(bucket.vertices ? of_world.body_of(item) : debug.boxes[item].body);
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::string text = bodies.size() == 1 ? "body " : "bodies ";
  const std::size_t named = bodies.size() <= max_named ? bodies.size() : max_named - 1;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) text += i + 1 == bodies.size() ? " and " : ", ";
    text += std::to_string(bodies[i]);
  }
  if (named < bodies.size()) text.append(" and ").append(std::to_string(bodies.size() - named)).append(" more");
  return text;
}

}  // namespace app::compare
