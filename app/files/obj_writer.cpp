#include "app/files/obj_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fmt/core.h>

#include "softbody/model/body_model.h"

namespace app::files {
namespace {

using softbody::Edge;
using softbody::Index;
using softbody::Triangle;

void add_face(std::string& text, std::size_t first, std::span<const Index> corners) {
  text += 'f';
  for (const Index corner : corners) text.append(1, ' ').append(std::to_string(first + corner + 1));
  text += '\n';
}

/// Adds the quad that two triangles form if their common side is a diagonal, which is no edge of the mesh. Returns
/// false if they form none.
bool add_quad(std::string& text, std::size_t first, const softbody::Mesh& mesh, const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Index from = a[i], to = a[(i + 1) % 3];
    const auto apex = std::ranges::find_if(b, [&](Index corner) { return corner != from && corner != to; });
    if (std::ranges::count(b, from) != 1 || std::ranges::count(b, to) != 1 || apex == b.end()) continue;
    if (std::ranges::binary_search(mesh.edges, Edge{std::min(from, to), std::max(from, to)})) return false;
    add_face(text, first, std::array{from, *apex, to, a[(i + 2) % 3]});
    return true;
  }
  return false;
}

std::string faces_of(const softbody::Mesh& mesh, std::size_t first) {
  std::string text;
  const std::vector<Triangle>& all = mesh.triangles;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i + 1 < all.size() && add_quad(text, first, mesh, all[i], all[i + 1]))
      ++i;
    else
      add_face(text, first, all[i]);
  }
  return text;
}

std::vector<const softbody::BodyModel*> models_of(const softbody::BodiesInMotion& world) {
  std::vector<const softbody::BodyModel*> list;
  for (softbody::BodyId b = 0; b < world.bodies().count(); ++b) list.push_back(&world.model(b));
  return list;
}

}  // namespace

ObjWriter::ObjWriter(const softbody::BodiesInMotion& world) : models_(models_of(world)), first_{0} {
  for (const softbody::BodyModel* model : models_) {
    faces_.push_back(faces_of(model->shown().mesh, first_.back()));
    for (const glm::dvec3& v : model->shown_at_rest()) {
      x_.push_back(static_cast<float>(v.x));
      y_.push_back(static_cast<float>(v.y));
      z_.push_back(static_cast<float>(v.z));
    }
    first_.push_back(x_.size());
  }
}

bool ObjWriter::matches(const softbody::BodiesInMotion& world) const { return models_ == models_of(world); }

bool ObjWriter::can_write(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
  const auto finite = [](float at) { return std::isfinite(at); };
  return std::ranges::all_of(x, finite) && std::ranges::all_of(y, finite) && std::ranges::all_of(z, finite);
}

std::string ObjWriter::frame(std::span<const float> x, std::span<const float> y, std::span<const float> z) const {
  assert(x.size() == first_.back() && y.size() == x.size() && z.size() == x.size() && can_write(x, y, z));
  std::string text;
  for (std::size_t b = 0; b < faces_.size(); ++b) {
    text += fmt::format("o body_{}\n", b);
    for (std::size_t i = first_[b]; i < first_[b + 1]; ++i)
      text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x[i], y[i], z[i]);
    text += faces_[b];
  }
  return text;
}

std::string ObjWriter::at_rest() const { return frame(x_, y_, z_); }

}  // namespace app::files
