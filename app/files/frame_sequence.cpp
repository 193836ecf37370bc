#include "app/files/frame_sequence.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/base/usage_error.h"
#include "app/files/inputs.h"
#include "collide/surface/box_tree.h"

namespace app::files {
namespace {

using collide::Index;

bool same_mesh(const BodyMeshes& meshes, std::size_t a, std::size_t b) {
  const auto polygons = [&](std::size_t body) { return meshes.first_polygon[body + 1] - meshes.first_polygon[body]; };
  if (meshes.size(a) != meshes.size(b) || polygons(a) != polygons(b)) return false;
  for (std::size_t p = 0; p < polygons(a); ++p)
    if (!std::ranges::equal(meshes.polygons[meshes.first_polygon[a] + p], meshes.polygons[meshes.first_polygon[b] + p]))
      return false;
  return true;
}

/// Adds to `bodies` those of `meshes` that it lacks. rest: the positions of all vertices at rest, if they are known.
/// Consecutive copies of a mesh share a topology.
void add_bodies(collide::Bodies& bodies, const BodyMeshes& meshes, const softbody::Points* rest) {
  for (std::size_t b = bodies.count(); b < meshes.count(); ++b) {
    std::vector<glm::vec3> positions;
    for (Index v = meshes.first[b]; rest && v < meshes.first[b + 1]; ++v)
      positions.emplace_back(rest->x[v], rest->y[v], rest->z[v]);
    bodies.add(std::make_shared<collide::Shape>(
        b > 0 && same_mesh(meshes, b, b - 1)
            ? bodies.shape.back()->shared_topology()
            : std::make_shared<collide::Topology>(meshes.size(b), meshes.edges(b), meshes.fans(b)),
        std::move(positions)));
  }
}

/// Returns how many of the first bodies have the same vertices in both.
std::size_t common_bodies(const BodyMeshes& one, const BodyMeshes& other) {
  std::size_t b = 0;
  while (b < one.count() && b < other.count() && one.size(b) == other.size(b) &&
         std::equal(one.file_vertex.begin() + one.first[b], one.file_vertex.begin() + one.first[b + 1],
                    other.file_vertex.begin() + other.first[b]))
    ++b;
  return b;
}

}  // namespace

FrameSequence::FrameSequence(std::vector<std::filesystem::path> files, const Options& options)
    : files_(std::move(files)), may_grow_(options.may_grow), reading_{.doubles = options.any_distance} {
  assert(!files_.empty());
  for (const std::filesystem::path& file : files_) protect_input(file);
  if (options.rest) protect_input(*options.rest);
  const softbody::FileMesh mesh = softbody::read_file_mesh(files_.front(), reading_);
  if (options.any_distance && !mesh.x.empty()) {
    collide::surface::Box box;
    for (std::size_t v = 0; v < mesh.x.size(); ++v) box.add(mesh.position(v));
    origin_ = softbody::origin_near(box.lo, box.hi);
  }
  by_ = options.by.value_or(default_bodies_by(mesh));
  const auto first = std::make_shared<SequenceBodies>();
  first->meshes = divide(mesh, by_, files_.front(), notes_);
  first_at_ = positions_of(mesh, first->meshes, origin_);
  first_ = last_ = first;
  const softbody::Points rest = options.rest ? read(*options.rest, false).at : softbody::Points{};
  add_bodies(first->bodies, first->meshes, options.rest ? &rest : nullptr);
}

SequenceFrame FrameSequence::read(std::size_t frame) {
  assert(frame < count());
  if (frame == 0 && first_at_) return {first_, *std::exchange(first_at_, std::nullopt)};
  return read(files_[frame], may_grow_);
}

SequenceFrame FrameSequence::read(const std::filesystem::path& file, bool may_grow) {
  const softbody::FileMesh mesh = softbody::read_file_mesh(file, reading_);
  SequenceFrame frame{first_, {}};
  if (by_ == BodiesBy::objects || !mesh.faces.empty() || mesh.x.size() != first_->meshes.vertex_count()) {
    std::vector<std::string> notes;
    frame.of = find(divide(mesh, by_, file, notes), file, may_grow);
    for (const std::string& note : notes) {
      std::string named = file.string() + ": " + note;
      if (std::ranges::find(notes_, note) == notes_.end() && std::ranges::find(notes_, named) == notes_.end())
        notes_.push_back(std::move(named));
    }
  }
  frame.at = positions_of(mesh, frame.of->meshes, origin_);
  return frame;
}

/// Returns the known bodies with the same vertices, or makes new ones. Throws UsageError unless they begin with those
/// of the first file and, if they may not grow, end there.
std::shared_ptr<const SequenceBodies> FrameSequence::find(BodyMeshes meshes, const std::filesystem::path& file,
                                                          bool may_grow) {
  const auto refuse = [&](const std::string& what) {
    throw UsageError(file.string() + ": " + what + "; give files that match body by body");
  };
  const auto refuse_number = [&](const std::string& of, std::size_t here, std::size_t there) {
    refuse(of + " " + std::to_string(here) + ", in " + files_.front().string() + " " + std::to_string(there));
  };
  const BodyMeshes& first = first_->meshes;
  if (meshes.count() < first.count() || (!may_grow && meshes.count() > first.count()))
    refuse_number("number of bodies", meshes.count(), first.count());
  if (const std::size_t b = common_bodies(meshes, first); b < first.count()) {
    const std::string body = "body " + std::to_string(b);
    if (meshes.size(b) != first.size(b)) refuse_number("vertices of " + body, meshes.size(b), first.size(b));
    refuse(body + " has other vertices than in " + files_.front().string());
  }
  if (meshes.count() == first.count()) return first_;
  const std::size_t common = common_bodies(meshes, last_->meshes);
  if (common == meshes.count() && common == last_->meshes.count()) return last_;
  const auto grown = std::make_shared<SequenceBodies>();
  grown->meshes = std::move(meshes);
  for (std::size_t b = 0; b < common; ++b) grown->bodies.add(last_->bodies.shape[b]);
  add_bodies(grown->bodies, grown->meshes, nullptr);
  return last_ = grown;
}

}  // namespace app::files
