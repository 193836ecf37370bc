#include "softbody/mesh_import.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/limits.h"
#include "softbody/obj_file.h"
#include "softbody/polygon.h"
#include "softbody/surface.h"
#include "softbody/toml_text.h"

namespace softbody {
namespace {

constexpr Index no_vertex = ~Index{0};

struct Box {
  glm::dvec3 lo{INFINITY}, hi{-INFINITY};
  void add(const glm::dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  double extent() const { return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}); }
};

/// Finds for each point the first one before it that is no further away than `distance`, by a grid of such cells.
class Welder {
 public:
  Welder(double distance, double extent) : distance_(distance), cell_(std::max(distance, 1e-9 * extent)) {}

  /// The number of the point that this one is welded to: its own if there is none.
  Index add(const glm::dvec3& point, Index number) {
    const glm::dvec3 cell = glm::floor(point / cell_);
    for (int n = 0; n < 27; ++n) {
      const auto there = cells_.find(key(cell + glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
      if (there == cells_.end()) continue;
      for (const auto& [other, position] : there->second)
        if (glm::distance(position, point) <= distance_) return other;
    }
    cells_[key(cell)].emplace_back(number, point);
    return number;
  }

 private:
  /// Cells that share a key cost time only.
  static std::uint64_t key(const glm::dvec3& cell) {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) h = (h ^ static_cast<std::uint64_t>(std::int64_t(cell[k]))) * 0x9e3779b97f4a7c15u;
    return h ^ (h >> 32);
  }

  double distance_, cell_;
  std::unordered_map<std::uint64_t, std::vector<std::pair<Index, glm::dvec3>>> cells_;
};

/// The rotation by the shortest way that brings `up` to the y axis.
glm::dmat3 to_y(const glm::dvec3& up) {
  const glm::dvec3 u = glm::normalize(up);
  if (u.y < -1 + 1e-12) return {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)};
  const glm::dvec3 v = glm::cross(u, glm::dvec3(0, 1, 0));
  const glm::dmat3 cross(glm::dvec3(0, v.z, -v.y), glm::dvec3(-v.z, 0, v.x), glm::dvec3(v.y, -v.x, 0));
  return glm::dmat3(1.0) + cross + cross * cross / (1 + u.y);
}

/// Equal for polygons of the same outline, wherever it begins and whichever way round it runs.
std::vector<Index> outline_key(std::vector<Index> polygon) {
  const auto from_least = [](std::vector<Index> corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
  };
  std::vector<Index> reversed = from_least({polygon.rbegin(), polygon.rend()});
  return std::min(from_least(std::move(polygon)), std::move(reversed));
}

class Importer {
 public:
  explicit Importer(const MeshFile& file) : file_(file), name_(file.path.string()) { require_sensible_file(); }

  ImportedMesh run() {
    const ObjFile obj = read_obj_file(file_.path);
    findings_.file_vertices = obj.x.size();
    findings_.file_faces = obj.faces.size();
    findings_.weights = obj.weights;
    if (obj.faces.empty()) fail("has no face (line f); export it as a mesh of polygons, not as points or lines");
    place(obj);
    weld();
    obj.for_each_face([&](std::span<const Index> corners, std::uint64_t line) { add_polygon(corners, line); });
    if (mesh_.triangles.empty()) fail("has no face with three different corners; lower weld, or check the export");
    compact();
    orient_faces();
    connect_triangles(mesh_);
    return {std::move(mesh_), findings_};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ObjError(name_ + ": " + what); }

  void require_sensible_file() const {
    std::error_code error;
    const auto size = std::filesystem::file_size(file_.path, error);
    if (error) fail("cannot be read: " + error.message());
    if (size > max_mesh_file_size)
      fail("is larger than " + std::to_string(max_mesh_file_size >> 20) + " MiB; simplify the mesh first");
  }

  /// Positions in metres around the middle of what the faces use.
  void place(const ObjFile& obj) {
    const std::size_t count = obj.x.size();
    std::vector<char> used(count, false);
    for (const Index corner : obj.corners) used[corner] = true;
    findings_.unused_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), char(false)));
    const glm::dmat3 turn = to_y(file_.up);
    Box box;
    for (std::size_t i = 0; i < count; ++i) {
      position_.push_back(turn * glm::dvec3(obj.x[i], obj.y[i], obj.z[i]));
      if (used[i]) box.add(position_.back());
    }
    findings_.file_extent = box.extent();
    if (!(box.extent() > 0)) fail("has all its faces in one point; check the export");
    const double size = file_.size > 0 ? file_.size : box.extent(), scale = size / box.extent();
    if (size < least_body_size || size > most_body_size)
      fail("is " + toml_value(size) + " m large (" + toml_value(least_body_size) + " to " +
           toml_value(std::int64_t(most_body_size)) +
           " are allowed); set size to the largest extent that it shall have, in m");
    findings_.extent = size;
    const glm::dvec3 middle = 0.5 * (box.lo + box.hi);
    for (glm::dvec3& p : position_) p = scale * (p - middle);
    welded_to_.assign(count, no_vertex);
    for (const Index corner : obj.corners) welded_to_[corner] = corner;
  }

  void weld() {
    Welder welder(file_.weld * findings_.extent, findings_.extent);
    for (Index i = 0; i < welded_to_.size(); ++i) {
      if (welded_to_[i] == no_vertex) continue;
      welded_to_[i] = welder.add(position_[i], i);
      if (welded_to_[i] != i) ++findings_.welded_vertices;
    }
  }

  void add_polygon(std::span<const Index> corners, std::uint64_t line) {
    polygon_.clear();
    for (const Index corner : corners)
      if (const Index v = welded_to_[corner]; polygon_.empty() || polygon_.back() != v) polygon_.push_back(v);
    while (polygon_.size() > 1 && polygon_.front() == polygon_.back()) polygon_.pop_back();
    if (polygon_.size() > max_polygon_corners)
      throw ObjError(name_ + ":" + std::to_string(line) + ": a face of " + std::to_string(polygon_.size()) +
                     " corners; at most " + std::to_string(max_polygon_corners) + " are allowed: export triangles");
    if (polygon_.size() < 3) return void(++findings_.degenerate_faces);
    if (!outlines_.insert(outline_key(polygon_)).second) return void(++findings_.duplicate_faces);
    outline_.clear();
    for (const Index v : polygon_) outline_.push_back(position_[v]);
    bool any = false;
    for (const auto& [a, b, c] : triangulate(outline_)) {
      const Triangle t{polygon_[a], polygon_[b], polygon_[c]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;  // of an outline that comes back to a vertex
      mesh_.triangles.push_back(t);
      any = true;
    }
    if (!any) ++findings_.degenerate_faces;
  }

  /// Leaves out the vertices that no triangle has.
  void compact() {
    std::vector<Index> number(position_.size(), no_vertex);
    for (Triangle& t : mesh_.triangles)
      for (Index& corner : t) {
        if (number[corner] == no_vertex) {
          number[corner] = static_cast<Index>(in_file_.size());
          in_file_.push_back(corner);
          mesh_.vertices.push_back(position_[corner]);
        }
        corner = number[corner];
      }
    if (in_file_.size() > max_imported_vertices)
      fail("has " + std::to_string(in_file_.size()) + " vertices; at most " + std::to_string(max_imported_vertices) +
           " are allowed: simplify the mesh first");
  }

  void orient_faces() {
    try {
      const SurfaceFindings found = orient(mesh_.triangles, mesh_.vertices);
      findings_.components = found.components;
      findings_.turned_faces = found.turned_faces;
      findings_.closed = found.border_edges == 0;
    } catch (const SurfaceError& error) {
      fail("the edge between vertices " + std::to_string(in_file_[error.edge[0]] + std::uint64_t{1}) + " and " +
           std::to_string(in_file_[error.edge[1]] + std::uint64_t{1}) + " (counted from 1) " + error.what() +
           "; repair the mesh, or change weld");
    }
    const double cube = findings_.extent * findings_.extent * findings_.extent;
    if (findings_.closed && volume(mesh_.vertices, mesh_.triangles) < 1e-9 * cube)
      fail("is closed but holds no volume; leave out one of its sides, or give it thickness");
  }

  const MeshFile& file_;
  std::string name_;
  std::vector<glm::dvec3> position_;  // of each vertex of the file
  std::vector<Index> welded_to_;      // vertex of the file; none: unused
  std::vector<Index> polygon_;
  std::set<std::vector<Index>> outlines_;  // outline_key() of each polygon so far
  std::vector<glm::dvec3> outline_;
  std::vector<Index> in_file_;  // of each vertex of the mesh
  Mesh mesh_;
  ImportFindings findings_;
};

}  // namespace

ImportedMesh import_mesh(const MeshFile& file) { return Importer(file).run(); }

std::string remarks(const ImportFindings& f) {
  std::string text;
  const auto add = [&text](std::size_t number, const char* what) {
    if (number > 0) text.append(text.empty() ? "" : ", ").append(std::to_string(number)).append(what);
  };
  add(f.welded_vertices, " vertices welded");
  add(f.unused_vertices, " unused vertices dropped");
  add(f.degenerate_faces, " degenerate faces dropped");
  add(f.duplicate_faces, " duplicate faces dropped");
  add(f.weights, " weights of vertices passed over");
  add(f.turned_faces, " faces turned");
  if (f.components > 1) add(f.components, " separate pieces, one body");
  if (!f.closed) text.append(text.empty() ? "" : ", ").append("open, so that it holds no gas");
  return text;
}

}  // namespace softbody
