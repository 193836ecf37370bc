#include "softbody/contact/solid_features.h"

namespace softbody {

std::vector<SolidCore> cores_of(const SolidSphere& sphere) { return {{sphere.centre, sphere.centre}}; }
std::vector<SolidCore> cores_of(const SolidPlane&) { return {}; }
std::vector<SolidCore> cores_of(const SolidCapsule& c) { return {{c.from, c.from}, {c.to, c.to}, {c.from, c.to}}; }

std::vector<SolidCore> cores_of(const SolidBox& box) {
  std::vector<SolidCore> cores;
  const auto out_of = [&](unsigned corner, int axis) { return (corner >> axis & 1 ? 1.0 : -1.0) * box.axes[axis]; };
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dvec3 at = box.centre, out(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      at += box.half_size[axis] * out_of(corner, axis);
      out += out_of(corner, axis);
    }
    cores.push_back({at, at, out});
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1) continue;
      cores.push_back({at, at + 2 * box.half_size[axis] * box.axes[axis], out - out_of(corner, axis)});
    }
  }
  return cores;
}

}  // namespace softbody
