#include "softbody/mesh/weld.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "softbody/mesh/sets.h"

namespace softbody {
namespace {

/// Returns a hash of a grid's cell. Cells with equal keys only cost time.
std::uint64_t key_of(const glm::dvec3& cell) {
  std::uint64_t h = 0;
  for (int k = 0; k < 3; ++k) h = (h ^ static_cast<std::uint64_t>(std::int64_t(cell[k]))) * 0x9e3779b97f4a7c15u;
  return h ^ (h >> 32);
}

/// Returns for each point the first earlier one that is used and within `distance`, by a grid of this cell size; itself
/// if there is none, or if it is not used.
std::vector<Index> first_at_places(std::span<const glm::dvec3> points, const std::vector<char>& used, double distance,
                                   double cell_size) {
  std::vector<Index> first(points.size());
  std::iota(first.begin(), first.end(), Index{0});
  std::unordered_map<std::uint64_t, std::vector<Index>> cells;
  for (Index v = 0; v < first.size(); ++v) {
    if (!used[v]) continue;
    const glm::dvec3 cell = glm::floor(points[v] / cell_size);
    for (int n = 0; n < 27 && first[v] == v; ++n) {
      const auto there = cells.find(key_of(cell + glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
      if (there == cells.end()) continue;
      const auto near = std::ranges::find_if(
          there->second, [&](Index other) { return glm::distance(points[other], points[v]) <= distance; });
      if (near != there->second.end()) first[v] = *near;
    }
    if (first[v] == v) cells[key_of(cell)].push_back(v);
  }
  return first;
}

/// A side of a face.
struct PolygonSide {
  Edge place;  // of its ends, ascending
  Edge ends;   // vertices, in the order of `place`
  auto operator<=>(const PolygonSide&) const = default;
};

/// Calls visit(begin, end) for each run of sorted sides for which key(side) is the same.
void for_each_run(std::span<const PolygonSide> sides, const auto& key, const auto& visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && std::invoke(key, sides[end]) == std::invoke(key, sides[begin])) ++end;
    visit(sides.subspan(begin, end - begin));
  }
}

/// Returns a key that is equal for polygons of the same outline, whatever their first corner and direction.
std::vector<Index> outline_key(std::vector<Index> polygon) {
  const auto from_least = [](std::vector<Index> corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
  };
  std::vector<Index> reversed = from_least({polygon.rbegin(), polygon.rend()});
  return std::min(from_least(std::move(polygon)), std::move(reversed));
}

class Seams {
 public:
  Seams(const FileMesh& file, std::vector<Index> place)
      : place_(std::move(place)),
        object_(place_.size()),
        without_length_(place_.size()),
        pieces_(place_.size()),
        scope_(place_.size(), Scope::file) {
    Index object = 0;
    file.for_each_face([&](std::span<const Index> corners, std::size_t face) {
      while (object + 1 < file.objects.size() && file.objects[object + 1].first_face <= face) ++object;
      for (const Index corner : corners) object_[corner] = object;
      for (std::size_t i = 0; i < corners.size(); ++i)
        if (const Index a = corners[i], b = corners[(i + 1) % corners.size()]; place_[a] == place_[b])
          without_length_.unite(a, b);
    });
    for (Index v = 0; v < place_.size(); ++v) welded_to_.push_back(without_length_.find(v));
    polygons_ = outlines(file, welded_to_).polygons;
    ends_open_side_.resize(place_.size(), false);
    for_each_run(sides(), std::identity(), [&](std::span<const PolygonSide> same) {
      if (same.size() > 1) return;
      open_sides_.push_back(same[0]);
      for (const Index v : same[0].ends) ends_open_side_[v] = true;
    });
    for (std::size_t p = 0; p < polygons_.size(); ++p)
      for (const Index v : polygons_[p]) pieces_.unite(v, polygons_[p][0]);
  }

  std::vector<Index> run() {
    weld();
    for (const auto& [scope, prepare] : {std::pair(Scope::piece, &Seams::join_pieces),
                                         {Scope::object, nullptr},
                                         {Scope::piece, &Seams::join_neighbours},
                                         {Scope::file, nullptr}}) {
      if (!change_scope_of_bad_places(scope)) break;
      if (prepare) (this->*prepare)();
      weld();
    }
    weld_copies();
    return std::move(welded_to_);
  }

 private:
  /// Which vertices at a place are welded: all of the file, or those of the same piece or object.
  enum class Scope : char { file, piece, object };

  /// Returns the sides of all polygons, ascending.
  std::vector<PolygonSide> sides() const {
    std::vector<PolygonSide> all;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const std::span<const Index> polygon = polygons_[p];
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        Index a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (place_[b] < place_[a]) std::swap(a, b);
        all.push_back({{place_[a], place_[b]}, {welded_to_[a], welded_to_[b]}});
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  /// Welds the vertices at each place according to the place's scope.
  void weld() {
    std::unordered_map<std::uint64_t, Index> first;  // by place and part
    for (Index v = 0; v < place_.size(); ++v) {
      const Index root = without_length_.find(v);
      welded_to_[v] = root;
      if (!ends_open_side_[root]) continue;
      const Scope scope = scope_[place_[v]];
      const Index part = scope == Scope::file ? 0 : scope == Scope::piece ? pieces_.find(root) : object_[root];
      welded_to_[v] = first.try_emplace(std::uint64_t{place_[v]} << 32 | part, root).first->second;
    }
  }

  /// Unites faces to one piece that are welded to each other where the scope is the whole file.
  void join_pieces() {
    for (Index v = 0; v < place_.size(); ++v)
      if (scope_[place_[v]] == Scope::file) pieces_.unite(without_length_.find(v), welded_to_[v]);
  }

  /// Where more than two open sides are at the same place, unites two pieces whose sides follow one another in the
  /// file.
  void join_neighbours() {
    for_each_run(open_sides_, &PolygonSide::place, [&](std::span<const PolygonSide> there) {
      if (there.size() <= 2) return;
      std::vector<Index> alone;  // pieces
      for (const PolygonSide& side : there) {
        const Index piece = pieces_.find(side.ends[0]);
        const auto other = std::ranges::find(alone, piece);
        if (other == alone.end())
          alone.push_back(piece);
        else
          alone.erase(other);
      }
      if (alone.size() % 2 != 0) return;
      for (std::size_t i = 0; i < alone.size(); i += 2) pieces_.unite(alone[i], alone[i + 1]);
    });
  }

  /// Changes the scope of bad places: ends of edges with more than two faces, and ends of more than two open sides at
  /// one place that are not kept apart by objects. Returns false if there are none.
  bool change_scope_of_bad_places(Scope scope) {
    std::vector<Index> bad;
    for_each_run(sides(), &PolygonSide::place, [&](std::span<const PolygonSide> there) {
      std::size_t most = 0, open = 0;
      for_each_run(there, std::identity(), [&](std::span<const PolygonSide> same) {
        most = std::max(most, same.size());
        open += same.size() == 1;
      });
      const Edge& place = there[0].place;
      const bool by_object = scope_[place[0]] == Scope::object && scope_[place[1]] == Scope::object;
      if (most > 2 || (open > 2 && !by_object)) bad.insert(bad.end(), place.begin(), place.end());
    });
    for (const Index place : bad) scope_[place] = scope;
    return !bad.empty();
  }

  /// Welds pieces whose faces all lie on faces of other pieces to those.
  void weld_copies() {
    Sets pieces(place_.size());
    std::map<std::vector<Index>, std::size_t> first;  // polygon by outline
    std::vector<std::size_t> original;                // of each polygon
    std::vector<char> is_copy(place_.size(), true);   // by piece
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      std::vector<Index> outline;
      for (const Index v : polygons_[p]) {
        pieces.unite(welded_to_[v], welded_to_[polygons_[p][0]]);
        outline.push_back(place_[v]);
      }
      original.push_back(first.try_emplace(outline_key(std::move(outline)), p).first->second);
    }
    const auto piece = [&](std::size_t p) { return pieces.find(welded_to_[polygons_[p][0]]); };
    for (std::size_t p = 0; p < polygons_.size(); ++p)
      if (piece(original[p]) == piece(p)) is_copy[piece(p)] = false;
    std::vector<Index> becomes(place_.size());
    std::iota(becomes.begin(), becomes.end(), Index{0});
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      if (!is_copy[piece(p)]) continue;
      for (const Index v : polygons_[p])
        becomes[welded_to_[v]] = welded_to_[*std::ranges::find(polygons_[original[p]], place_[v],
                                                               [&](Index corner) { return place_[corner]; })];
    }
    for (Index& v : welded_to_) v = becomes[v];
  }

  std::vector<Index> place_;   // of each vertex: the first one at the same place
  std::vector<Index> object_;  // of each vertex: the last one whose faces use it
  Sets without_length_;        // joined by sides that have none
  Polygons polygons_;          // of the first vertices of those sets
  Sets pieces_;                // of faces that hang together
  std::vector<PolygonSide> open_sides_;
  std::vector<char> ends_open_side_;
  std::vector<Scope> scope_;  // of each place: vertices of the same one are welded
  std::vector<Index> welded_to_;
};

}  // namespace

Outlines outlines(const FileMesh& file, std::span<const Index> welded_to) {
  Outlines found;
  std::set<std::vector<Index>> known;
  std::vector<Index> outline;
  file.for_each_face([&](std::span<const Index> corners, std::size_t face) {
    outline.clear();
    for (const Index corner : corners) {
      const Index v = welded_to[corner];
      if (!outline.empty() && outline.back() == v) continue;
      if (outline.size() > 1 && outline[outline.size() - 2] == v)
        outline.pop_back();
      else
        outline.push_back(v);
    }
    std::span<const Index> rest(outline);
    while (rest.size() > 2) {  // the same where the end meets the beginning
      const bool spike_at_front = rest[1] == rest.back(), spike_at_back = rest[rest.size() - 2] == rest.front();
      if (rest.front() != rest.back() && !spike_at_front && !spike_at_back) break;
      rest = spike_at_front ? rest.subspan(1) : rest.first(rest.size() - 1);
    }
    if (rest.size() < 3) return void(++found.degenerate_faces);
    if (!known.insert(outline_key({rest.begin(), rest.end()})).second) return void(++found.duplicate_faces);
    found.polygons.corners.insert(found.polygons.corners.end(), rest.begin(), rest.end());
    found.polygons.ends.push_back(found.polygons.corners.size());
    found.face.push_back(face);
  });
  return found;
}

std::vector<Index> weld(const FileMesh& file, std::span<const glm::dvec3> points, double distance) {
  assert(distance >= 0 && points.size() == file.x.size());
  std::vector<char> used(points.size(), false);
  double reach = 0;
  for (const Index corner : file.corners) {
    used[corner] = true;
    for (int k = 0; k < 3; ++k) reach = std::max(reach, std::abs(points[corner][k]));
  }
  std::vector<Index> place = first_at_places(points, used, distance, std::max(distance, 1e-9 * reach));
  bool shared = false;
  for (Index v = 0; v < place.size(); ++v) shared = shared || place[v] != v;
  if (!shared) return place;
  return Seams(file, std::move(place)).run();
}

}  // namespace softbody
