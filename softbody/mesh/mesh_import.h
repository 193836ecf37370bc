#pragma once
// Imports a mesh from an OBJ or PLY file and prepares it for a soft body: it comes to the origin, seams are welded,
// polygons are cut into triangles, unused vertices are dropped, faces are turned outwards, and the surface is checked.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "softbody/mesh/coarse_mesh.h"
#include "softbody/mesh/surface.h"

namespace softbody {

struct MeshFile {
  std::filesystem::path path{};
  double size = 0;         // m, the mesh is scaled to this largest extent; 0: not scaled, the file is in metres
  double weld = 1e-6;      // seams no wider than this times the largest extent are closed (weld.h)
  glm::dvec3 up{0, 1, 0};  // the file's direction that becomes y, of any length but 0
  /// About so many particles simulate the mesh if it has more vertices; 0: default_resolution of them, if it has more
  /// than max_simulated_vertices.
  std::size_t resolution = 0;
  bool operator==(const MeshFile&) const = default;
};

inline constexpr std::size_t max_simulated_vertices = 1000, default_resolution = 800;
inline constexpr std::size_t min_resolution = 50;  // a leg or an ear needs some vertices

/// What the import found in the file and what it changed.
struct ImportFindings : SurfaceFindings {
  std::size_t welded_vertices = 0;   // dropped: another vertex is at the same place
  std::size_t unused_vertices = 0;   // dropped: no face uses them
  std::size_t degenerate_faces = 0;  // dropped: fewer than three corners were left after welding
  std::size_t duplicate_faces = 0;   // dropped: an earlier face has the same outline, in either direction
  std::size_t weights = 0;           // vertices with a weight other than 1, which is ignored
  double file_extent = 0;            // largest extent before scaling
  double coarse_step = 0;            // the file's coordinates are multiples of it, too coarse; 0: fine
  double extent = 0;                 // m, after scaling
  bool too_fine = false;             // a coarse mesh was asked for, but none keeps the form of the mesh
  bool operator==(const ImportFindings&) const = default;
};

struct ImportedMesh {
  Mesh mesh;  // the middle of its bounding box is its origin
  ImportFindings findings;
  std::optional<CoarseMesh> coarse{};  // is simulated in place of `mesh`

  const Mesh& simulated() const { return coarse ? coarse->mesh : mesh; }
};

/// Adds the coarse mesh that is simulated in place of `mesh`, if that is too fine, and says so in the findings.
/// resolution: as in MeshFile.
void add_coarse_mesh(ImportedMesh& imported, std::size_t resolution);

inline constexpr std::size_t max_imported_vertices = 100'000;                    // after welding
inline constexpr std::uintmax_t max_mesh_file_size = std::uintmax_t{256} << 20;  // bytes

/// Imports all objects of the file as one mesh. Throws MeshFileError (file_mesh.h) if the file cannot be read, has no
/// face or is too large, or if the surface has an edge with more than two faces, has one side only, or is closed
/// without a volume. begin_stage: called with what is done next, e.g. "reading the file". If it throws, so does this.
ImportedMesh import_mesh(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage = {});

/// Returns one line for people, e.g. "12 vertices welded, 3 unused ones dropped; open; 2 components". It is empty for a
/// closed mesh in one piece that was not changed.
std::string remarks(const ImportedMesh& imported);

/// Where a body's mesh comes from.
struct MeshSource {
  std::string kind = "icosphere";
  int subdivisions = 2;                            // icosphere
  double radius = 0.5;                             // m, icosphere
  int columns = 32, rows = 32;                     // grid
  double width = 3, depth = 3;                     // m, grid
  MeshFile file{};                                 // file
  std::shared_ptr<const ImportedMesh> imported{};  // file: the imported mesh, shared by all its bodies
  /// Imports the file as import_mesh() does.
  static MeshSource from_file(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage = {});
  /// Returns the mesh that is simulated.
  Mesh make() const;
  /// Returns the number of vertices of the mesh that is shown, without making it.
  std::uint64_t vertex_count() const;
  bool operator==(const MeshSource&) const = default;
};

}  // namespace softbody
