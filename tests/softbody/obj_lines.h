#pragma once
// Lines of OBJ files.

#include <initializer_list>
#include <sstream>
#include <string>

#include <glm/vec3.hpp>

namespace softbody::test {

inline std::string vertex(const glm::dvec3& p) {
  std::ostringstream s;
  s << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  return s.str();
}

inline std::string face(std::initializer_list<int> corners) {
  std::ostringstream s;
  s << 'f';
  for (const int corner : corners) s << ' ' << corner;
  s << '\n';
  return s.str();
}

inline const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

}  // namespace softbody::test
