// make_shapes FOLDER [VERTICES]: writes the shapes of assets/meshes as PLY files into the folder, with about as many
// vertices as asked for, or as many as the shipped ones have.

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/shapes/mesher.h"
#include "tests/shapes/shapes.h"

namespace {

/// Writes a mesh as a binary PLY file.
void write_ply(const softbody::Mesh& mesh, const std::filesystem::path& path) {
  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto write = [&out](const auto& value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const glm::dvec3& v : mesh.vertices) write(glm::vec3(v));
  for (const softbody::Triangle& t : mesh.triangles) {
    write(std::uint8_t{3});
    write(t);
  }
  if (!out.flush()) throw std::filesystem::filesystem_error("cannot be written", path, {});
}

}  // namespace

int main(int count, char** words) try {
  int vertices = 0;
  if (count == 3) {
    const std::string_view word(words[2]);
    std::from_chars(word.data(), word.data() + word.size(), vertices);
  }
  if (count < 2 || count > 3 || (count == 3 && vertices < 500)) {
    std::cerr << "make_shapes FOLDER [VERTICES, 500 or more]\n";
    return 2;
  }
  std::filesystem::create_directories(words[1]);
  for (const shapes::Shape& shape : shapes::shapes) {
    softbody::Mesh mesh = shapes::make_mesh(shape.make(), vertices > 0 ? vertices : shape.vertices);
    softbody::connect_triangles(mesh);
    if (!mesh.closed) throw std::runtime_error(std::string(shape.name) + ": too few vertices for its thin parts");
    const auto path = std::filesystem::path(words[1]) / (std::string(shape.name) + ".ply");
    write_ply(mesh, path);
    std::cout << path.string() << ": " << mesh.vertices.size() << " vertices, " << mesh.triangles.size()
              << " triangles\n";
  }
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
