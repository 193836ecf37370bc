#include "softbody/mesh/mesh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "collide/surface/box_tree.h"
#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/limits.h"
#include "softbody/mesh/polygon.h"
#include "softbody/mesh/shortest_text.h"
#include "softbody/mesh/surface.h"
#include "softbody/mesh/weld.h"

namespace softbody {
namespace {

using collide::surface::Box;

constexpr const char* where_weld_is = "(in the window under Files, in a scene beside the mesh's path)";

/// Returns the smallest rotation that brings `up` to the y axis.
glm::dmat3 to_y(const glm::dvec3& up) {
  const glm::dvec3 u = glm::normalize(up);
  if (u.y < -1 + 1e-12) return {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)};
  const glm::dvec3 v = glm::cross(u, glm::dvec3(0, 1, 0));
  const glm::dmat3 cross(glm::dvec3(0, v.z, -v.y), glm::dvec3(-v.z, 0, v.x), glm::dvec3(v.y, -v.x, 0));
  return glm::dmat3(1.0) + cross + cross * cross / (1 + u.y);
}

double extent(const Box& box) { return std::max({box.extent(0), box.extent(1), box.extent(2)}); }

std::string two_digits(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

/// Returns the step between the values that a file can give for the largest coordinate along an axis. at: of all
/// vertices; corners: those that count.
double step_of(std::span<const double> at, std::span<const Index> corners, int digits) {
  double largest = 0;
  for (const Index v : corners) largest = std::max(largest, std::abs(at[v]));
  const bool floats = std::ranges::all_of(corners, [&](Index v) { return double(static_cast<float>(at[v])) == at[v]; });
  const double binary = floats ? largest - double(std::nextafter(static_cast<float>(largest), 0.0f))
                               : largest - std::nextafter(largest, 0.0);
  const bool written = digits > 0 && largest > 0;
  return written ? std::max(binary, std::pow(10, std::floor(std::log10(largest)) + 1 - digits)) : binary;
}

std::string advice_on_digits(double step) {
  return "the file gives coordinates in steps of " + two_digits(step) +
         ", which is much of its edges: export it with more digits, or nearer to the origin";
}

class Importer {
 public:
  Importer(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage)
      : file_(file), name_(file.path.string()), begin_stage_(begin_stage) {
    require_sensible_file();
  }

  ImportedMesh run() {
    begin("reading the file");
    mesh_file_ = read_file_mesh(file_.path, {.doubles = true});
    findings_.weights = mesh_file_.weights;
    if (mesh_file_.faces.empty()) fail("has no face; export it as a mesh of polygons, not as points or lines");
    begin("closing seams");
    place();
    welded_to_ = weld(mesh_file_, position_, file_.weld * findings_.extent);
    for (Index v = 0; v < welded_to_.size(); ++v) findings_.welded_vertices += welded_to_[v] != v;
    begin("cutting polygons into triangles");
    take_outlines();
    cut_polygons();
    in_file_ = renumber_vertices(mesh_.triangles);
    for (const Index v : in_file_) mesh_.vertices.push_back(position_[v]);
    begin("turning faces outwards");
    orient_faces();
    connect_triangles(mesh_);
    begin("making a coarse mesh to simulate");
    ImportedMesh imported{std::move(mesh_), findings_};
    add_coarse_mesh(imported, file_.resolution);
    return imported;
  }

 private:
  void begin(std::string_view stage) const {
    if (begin_stage_) begin_stage_(stage);
  }
  [[noreturn]] void fail(const std::string& what) const { fail_at("", what); }
  [[noreturn]] void fail_at(const std::string& place, const std::string& what) const {
    const double step = findings_.coarse_step;
    throw MeshFileError(name_ + ":" + place + " " + what + (step > 0 ? "; " + advice_on_digits(step) : ""));
  }
  [[noreturn]] void fail_at(std::size_t polygon, const std::string& what) const {
    fail_at(mesh_file_.place(outlines_.face[polygon]) + ":", what);
  }

  void require_sensible_file() const {
    std::error_code error;
    const auto size = std::filesystem::file_size(file_.path, error);
    if (error) fail("cannot be read: " + error.message());
    if (size > max_mesh_file_size)
      fail("is larger than " + std::to_string(max_mesh_file_size >> 20) + " MiB; simplify the mesh first");
  }

  /// Finds positions in metres: floats, but relative to the middle of the bounding box of the vertices that faces use.
  /// Vertices that no face uses are left where that is.
  void place() {
    const std::size_t count = mesh_file_.x.size();
    std::vector<char> used(count, false);
    Box in_file, box;
    for (const Index corner : mesh_file_.corners) {
      used[corner] = true;
      in_file.add(mesh_file_.position(corner));
    }
    const glm::dvec3 most = glm::max(glm::abs(in_file.lo), glm::abs(in_file.hi));
    if (std::max({most.x, most.y, most.z}) > double{std::numeric_limits<float>::max()})
      fail("has a coordinate beyond 3.4e38; move it to the origin, or make it smaller");
    findings_.unused_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), char(false)));
    findings_.coarse_step = coarse_step();
    const glm::dvec3 origin = origin_near(in_file.lo, in_file.hi);
    const glm::dmat3 turn = to_y(file_.up);
    for (std::size_t i = 0; i < count; ++i) {
      position_.push_back(used[i] ? turn * glm::dvec3(glm::vec3(mesh_file_.position(i) - origin)) : glm::dvec3(0));
      if (used[i]) box.add(position_.back());
    }
    findings_.file_extent = extent(box);
    if (!(extent(box) > 0)) fail("has all its faces in one point; check the export");
    const double size = file_.size > 0 ? file_.size : extent(box), scale = size / extent(box);
    if (size < min_body_size || size > max_body_size)
      fail("is " + shortest_text(size) + " m large (" + shortest_text(min_body_size) + " to " +
           shortest_text(std::int64_t(max_body_size)) +
           " are allowed); set size to the largest extent that it shall have, in m");
    findings_.extent = size;
    const glm::dvec3 middle = 0.5 * (box.lo + box.hi);
    for (glm::dvec3& p : position_) p = scale * (p - middle);
  }

  /// Returns the step between the values of the file's coordinates if it is more than a tenth of the mean side of a
  /// face, unless the sides are those of a mesh of few forms, such as a cube, that is exact in such steps.
  double coarse_step() const {
    double step = 0;
    for (const std::vector<double>& axis : {std::cref(mesh_file_.x), std::cref(mesh_file_.y), std::cref(mesh_file_.z)})
      step = std::max(step, step_of(axis, mesh_file_.corners, mesh_file_.digits));
    const auto for_each_side = [&](const auto& visit) {
      mesh_file_.for_each_face([&](std::span<const Index> corners, std::size_t) {
        for (std::size_t i = 0; i < corners.size(); ++i)
          visit(mesh_file_.position(corners[i]) - mesh_file_.position(corners[i > 0 ? i - 1 : corners.size() - 1]));
      });
    };
    double sum = 0;
    for_each_side([&](const glm::dvec3& side) { sum += glm::length(side); });
    if (step <= 0.1 * sum / double(mesh_file_.corners.size())) return 0;
    constexpr std::size_t few = 12;
    std::set<std::array<double, 3>> forms;
    for_each_side([&](const glm::dvec3& side) {
      const glm::dvec3 steps = glm::round(glm::abs(side) / step);
      if (forms.size() <= few) forms.insert({steps.x, steps.y, steps.z});
    });
    return forms.size() > few || forms.contains({0, 0, 0}) ? step : 0;
  }

  void take_outlines() {
    outlines_ = outlines(mesh_file_, welded_to_);
    findings_.degenerate_faces = outlines_.degenerate_faces;
    findings_.duplicate_faces = outlines_.duplicate_faces;
    std::vector<char> used(position_.size(), false);
    for (const Index v : outlines_.polygons.corners) used[v] = true;
    const auto vertices = std::count(used.begin(), used.end(), char(true));
    if (vertices > std::ptrdiff_t(max_imported_vertices))
      fail("has " + std::to_string(vertices) + " vertices; at most " + std::to_string(max_imported_vertices) +
           " are allowed: simplify the mesh first");
    for (std::size_t p = 0; p < outlines_.face.size(); ++p)
      if (const std::size_t corners = outlines_.polygons[p].size(); corners > max_polygon_corners)
        fail_at(p, "a face of " + std::to_string(corners) + " corners; at most " + std::to_string(max_polygon_corners) +
                       " are allowed: export triangles");
  }

  void cut_polygons() {
    try {
      Triangulation cut = triangulate(outlines_.polygons, position_);
      mesh_.triangles = std::move(cut.triangles);
      polygon_of_ = std::move(cut.polygon);
    } catch (const PolygonError& error) {
      fail_at(
          error.polygon,
          "a face that cannot be cut into triangles: each cut runs along an edge or a cut of other faces with the same "
          "vertices; repair the mesh, or export triangles");
    }
    if (mesh_.triangles.empty())
      fail("has no face with three different corners; check the export, or lower weld " + std::string(where_weld_is));
  }

  void orient_faces() {
    try {
      static_cast<SurfaceFindings&>(findings_) = orient(mesh_.triangles, mesh_.vertices);
    } catch (const SurfaceError& error) {
      fail(reason(error));
    }
    const double cube = findings_.extent * findings_.extent * findings_.extent;
    if (findings_.closed && volume(mesh_.vertices, mesh_.triangles) < 1e-9 * cube)
      fail("is closed but holds no volume; leave out one of its sides, or give it thickness");
  }

  /// Returns what is wrong with the surface, with line and vertex numbers of the file.
  std::string reason(const SurfaceError& error) const {
    std::vector<std::size_t> faces;
    for (const Index triangle : error.triangles) faces.push_back(outlines_.face[polygon_of_[triangle]]);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    const std::size_t first = faces.front(), listed = std::min(faces.size(), std::size_t{4});
    std::string places = mesh_file_.has_lines() ? "line" : "face";
    places.append(listed > 1 ? "s " : " ").append(std::to_string(mesh_file_.number_of(first)));
    for (std::size_t i = 1; i < listed; ++i)
      places.append(i + 1 < listed ? ", " : " and ").append(std::to_string(mesh_file_.number_of(faces[i])));
    if (!mesh_file_.has_lines()) places += " (counted from 0)";
    const bool one_sided = error.triangles.size() == 2;
    std::string text = one_sided ? "the surface " : "the edge between vertices " + edge_in(first, error.edge) + " ";
    text.append(error.what()).append(": see ").append(places);
    text += one_sided ? "; repair the mesh"
                      : "; delete all but two of these faces, or give parts that touch there vertices of their own";
    const bool moved = one_sided ? std::ranges::any_of(mesh_file_.corners, [&](Index v) { return moved_by_weld(v); })
                                 : end_moved_by_weld(error.edge, faces);
    return moved ? text + ", or lower weld " + where_weld_is : text;
  }

  /// Returns true for a vertex that the weld has brought to another place, where a smaller weld may leave it.
  bool moved_by_weld(Index vertex) const { return position_[vertex] != position_[welded_to_[vertex]]; }

  /// Returns true if the weld has moved a corner of these faces that became an end of this edge of the mesh.
  bool end_moved_by_weld(const Edge& edge, const std::vector<std::size_t>& faces) const {
    const auto is_moved_end = [&](Index corner) {
      const Index to = welded_to_[corner];
      return (to == in_file_[edge[0]] || to == in_file_[edge[1]]) && moved_by_weld(corner);
    };
    return std::ranges::any_of(
        faces, [&](std::size_t face) { return std::ranges::any_of(mesh_file_.corners_of(face), is_moved_end); });
  }

  /// Returns the vertex numbers that a face of the file has at its side that became this edge of the mesh.
  std::string edge_in(std::size_t face, const Edge& edge) const {
    const std::span<const Index> corners = mesh_file_.corners_of(face);
    const Edge welded = ordered(in_file_[edge[0]], in_file_[edge[1]]);
    Edge ends = welded;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      if (ordered(welded_to_[a], welded_to_[b]) == welded) ends = ordered(a, b);
    }
    const std::uint64_t from = mesh_file_.first_number();
    return std::to_string(ends[0] + from) + " and " + std::to_string(ends[1] + from) + " (counted from " +
           std::to_string(from) + ")";
  }

  const MeshFile& file_;
  std::string name_;
  const std::function<void(std::string_view)>& begin_stage_;
  FileMesh mesh_file_;
  std::vector<glm::dvec3> position_;  // of each vertex of the file
  std::vector<Index> welded_to_;      // vertex of the file
  Outlines outlines_;
  std::vector<Index> polygon_of_;  // of each triangle
  std::vector<Index> in_file_;     // of each vertex of the mesh
  Mesh mesh_;
  ImportFindings findings_;
};

}  // namespace

void add_coarse_mesh(ImportedMesh& imported, std::size_t resolution) {
  const std::size_t vertices = imported.mesh.vertices.size();
  if (vertices <= (resolution > 0 ? resolution : max_simulated_vertices)) return;
  imported.coarse = coarsen(imported.mesh, resolution > 0 ? resolution : default_resolution);
  imported.findings.too_fine = !imported.coarse;
}

ImportedMesh import_mesh(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage) {
  return Importer(file, begin_stage).run();
}

std::string remarks(const ImportedMesh& imported) {
  const ImportFindings& f = imported.findings;
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
  if (f.components - f.cavities > 1) add(f.components - f.cavities, " separate pieces, one body");
  add(f.cavities, f.cavities == 1 ? " cavity, which holds no gas" : " cavities, which hold no gas");
  const auto say = [&text](const std::string& what) { text.append(text.empty() ? "" : ", ").append(what); };
  if (!f.closed) say("open, so that it holds no gas");
  if (imported.coarse)
    say("simulated by " + std::to_string(imported.simulated().vertices.size()) +
        " particles, whose surface is within " + two_digits(1e3 * imported.coarse->distance) + " mm of the mesh");
  if (imported.coarse && imported.coarse->crossings > 0) say("the simulated surface crosses itself");
  if (f.too_fine) say("no coarse mesh has its form, so all vertices are simulated");
  if (f.coarse_step > 0) say(advice_on_digits(f.coarse_step));
  return text;
}

MeshSource MeshSource::from_file(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage) {
  return {
      .kind = "file", .file = file, .imported = std::make_shared<const ImportedMesh>(import_mesh(file, begin_stage))};
}

Mesh MeshSource::make() const {
  if (kind == "file") return imported->simulated();
  return kind == "grid" ? quad_grid(columns, rows, width, depth) : icosphere(subdivisions, radius);
}

std::uint64_t MeshSource::vertex_count() const {
  if (kind == "file") return imported->mesh.vertices.size();
  return kind == "grid" ? std::uint64_t(columns + 1) * std::uint64_t(rows + 1) : 10 * (1ull << (2 * subdivisions)) + 2;
}

}  // namespace softbody
