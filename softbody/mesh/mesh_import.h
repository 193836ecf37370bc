#pragma once
// A mesh from a Wavefront OBJ file, made fit for a soft body: seams welded, polygons cut into triangles, what is of no
// use dropped, faces turned outwards, checked.

#include <filesystem>
#include <string>

#include "softbody/mesh/mesh.h"

namespace softbody {

struct MeshFile {
  std::filesystem::path path{};
  double size = 0;         // m, largest extent that the mesh is brought to; 0: as large as the file has it, in metres
  double weld = 1e-6;      // seams no wider than this times the largest extent are closed (weld.h)
  glm::dvec3 up{0, 1, 0};  // the file's direction that becomes y, of any length but 0
  bool operator==(const MeshFile&) const = default;
};

/// What was found in the file and done to it.
struct ImportFindings {
  std::size_t file_vertices = 0, file_faces = 0;  // as written
  std::size_t welded_vertices = 0;                // gone, since another one is as good as at their place
  std::size_t unused_vertices = 0;                // gone, since no face names them
  std::size_t degenerate_faces = 0;               // gone, since welding left them fewer than three corners
  std::size_t duplicate_faces = 0;                // gone, since an earlier one has the same outline, either way round
  std::size_t weights = 0;                        // of vertices, other than 1: passed over
  std::size_t turned_faces = 0;                   // corners put in the other order
  std::size_t components = 0;                     // joined by edges; all are one body
  bool closed = false;                            // it holds a volume
  double file_extent = 0;                         // largest extent before scaling
  double extent = 0;                              // m, after it
  bool operator==(const ImportFindings&) const = default;
};

struct ImportedMesh {
  Mesh mesh;  // the middle of its bounding box is its origin
  ImportFindings findings;
};

inline constexpr std::size_t max_imported_vertices = 100'000;                    // after welding
inline constexpr std::uintmax_t max_mesh_file_size = std::uintmax_t{256} << 20;  // bytes

/// All objects of the file together are one mesh. Throws ObjError (obj_file.h): unreadable, no face, too large, an edge
/// with more than two faces, a surface with one side, closed without a volume.
ImportedMesh import_mesh(const MeshFile& file);

/// One line for people, e.g. "12 vertices welded, 3 unused ones dropped; open; 2 components". Empty if there is nothing
/// to say: a closed mesh in one piece, taken as it is.
std::string remarks(const ImportFindings& findings);

}  // namespace softbody
