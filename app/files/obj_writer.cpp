#include "app/files/obj_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fmt/core.h>

#include "app/files/output_file.h"
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

/// Returns the text of a scene file without names, since those of files may have any bytes; empty if there can be none:
/// what is played may be beyond the limits of scenes. A scene needs a dropper if it has no bodies.
std::string surroundings_of(const softbody::BodiesInMotion& world) {
  const softbody::Scene& of = world.scene();
  softbody::Scene scene;
  scene.method = of.method;
  scene.collision = of.collision;
  scene.solids = of.solids;
  scene.view = of.view;
  scene.materials.resize(1);
  scene.dropper.emplace();
  std::string text = surroundings_heading + softbody::scene_toml(scene, {});
  try {
    softbody::parse_scene(text, surroundings_name);
  } catch (const softbody::SceneError&) {
    text.clear();
  }
  return text;
}

}  // namespace

ObjWriter::ObjWriter(const softbody::BodiesInMotion& world)
    : models_(models_of(world)), first_{0}, surroundings_(surroundings_of(world)) {
  for (const softbody::BodyModel* model : models_) {
    faces_.push_back(faces_of(model->shown().mesh, first_.back()));
    rest_.add(model->shown_at_rest());
    first_.push_back(rest_.x.size());
  }
}

bool ObjWriter::matches(const softbody::BodiesInMotion& world) const { return models_ == models_of(world); }

void ObjWriter::write_surroundings(const std::filesystem::path& folder) const {
  if (!surroundings_.empty()) write_file(folder / surroundings_name, surroundings_);
}

bool ObjWriter::can_write(const softbody::ConstPoints& at) {
  const auto finite = [](float axis) { return std::isfinite(axis); };
  return std::ranges::all_of(at.x, finite) && std::ranges::all_of(at.y, finite) && std::ranges::all_of(at.z, finite);
}

std::string ObjWriter::frame(const softbody::ConstPoints& at) const {
  assert(at.x.size() == first_.back() && at.y.size() == at.x.size() && at.z.size() == at.x.size() && can_write(at));
  std::string text;
  for (std::size_t b = 0; b < faces_.size(); ++b) {
    text += fmt::format("o body_{}\n", b);
    for (std::size_t i = first_[b]; i < first_[b + 1]; ++i)
      text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", at.x[i], at.y[i], at.z[i]);
    text += faces_[b];
  }
  return text;
}

}  // namespace app::files
