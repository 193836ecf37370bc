#include "app/files/playback.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/files/inputs.h"
#include "app/files/obj_writer.h"
#include "collide/surface/surface.h"
#include "softbody/world/body_model_set.h"

namespace app::files {
namespace {

/// Returns the mesh of a body with these triangles, in the shape that it has in this frame.
softbody::Mesh mesh_of(const BodyMeshes& meshes, std::size_t body, const softbody::Points& at,
                       std::vector<softbody::Triangle> triangles) {
  softbody::Mesh mesh;
  const collide::Index vertices = meshes.first[body + 1] - meshes.first[body];
  mesh.closed = collide::surface::Surface(vertices, triangles).closed();
  mesh.triangles = std::move(triangles);
  for (collide::Index v = meshes.first[body]; v < meshes.first[body + 1]; ++v)
    mesh.vertices.emplace_back(at.x[v], at.y[v], at.z[v]);
  for (const auto& [a, b] : meshes.edges(body))
    if (a != b) mesh.edges.push_back(softbody::ordered(a, b));
  std::ranges::sort(mesh.edges);
  mesh.edges.erase(std::unique(mesh.edges.begin(), mesh.edges.end()), mesh.edges.end());
  return mesh;
}

std::size_t bytes_of(const RecordedFrame& frame) { return 3 * sizeof(float) * frame.x.size(); }

/// Returns true if the model is that of all bodies with this shape and these triangles.
bool suits(const softbody::BodyModel& model, const collide::Shape& shape,
           const std::vector<softbody::Triangle>& triangles) {
  return model.shape->shared_topology() == shape.shared_topology() && model.shape->rest() == shape.rest() &&
         model.mesh.triangles == triangles;
}

/// Returns the scene that a recording of this program left beside this frame, if it is one of its frames.
std::optional<softbody::Scene> scene_around(const std::filesystem::path& frame) {
  if (!std::regex_match(frame.filename().string(), std::regex("frame_[0-9]+\\.obj"))) return {};
  const std::filesystem::path file = frame.parent_path() / surroundings_name;
  if (std::error_code ignored; !std::filesystem::exists(file, ignored)) return {};
  protect_input(file);
  return softbody::load_scene(file, softbody::presets_path(scene_folder()));
}

}  // namespace

Playback::Playback(std::vector<std::filesystem::path> files, std::optional<BodiesBy> by, std::size_t kept_bytes,
                   bool in_scene)
    : sequence_(std::move(files), {.by = by, .may_grow = true, .any_distance = !in_scene}), free_bytes_(kept_bytes) {
  const std::shared_ptr<const RecordedFrame> first = frame(0);
  if (first->x.empty())
    throw softbody::SceneError(sequence_.file(0).string() + ": has no vertex; nothing can be played");
  include(*first);
  command_words_ = {"--bodies",
                    std::string(std::ranges::find(bodies_by_keys, sequence_.by(), &BodiesByKey::value)->key), "--play"};
  for (std::size_t file = 0; file < sequence_.count(); ++file)
    command_words_.push_back(std::filesystem::absolute(sequence_.file(file)).string());
  for (const int number : {(frame_count() - 1) / 2, frame_count() - 1}) {
    try {
      include(*frame(number));
    } catch (const std::exception&) {  // it is reported when it is shown
    }
  }
}

/// Makes bounds() large enough for a frame.
void Playback::include(const RecordedFrame& frame) {
  for (std::size_t v = 0; v < frame.x.size(); ++v) bounds_.add(glm::dvec3(softbody::ConstPoints(frame)[v]));
}

std::shared_ptr<const RecordedFrame> Playback::frame(int number) {
  assert(number >= 0 && number < frame_count());
  const auto known = kept_.find(number);
  std::shared_ptr<const RecordedFrame> frame = known == kept_.end() ? nullptr : known->second;
  if (!frame) {
    try {
      frame = record(number, read(number));
    } catch (const std::runtime_error& error) {  // of the file
      throw softbody::SceneError(error.what());
    }
    const std::size_t bytes = bytes_of(*frame);
    if (number == 0 || bytes <= free_bytes_) {
      free_bytes_ -= std::min(free_bytes_, bytes);
      kept_.emplace(number, frame);
    }
  }
  read_ahead((number + 1) % frame_count());
  return frame;
}

/// Reads a frame now, unless it was read ahead.
SequenceFrame Playback::read(int number) {
  if (const auto thrown = ahead_ ? ahead_->wait() : std::nullopt; thrown && next_number_ == number) {
    if (*thrown) std::rethrow_exception(*thrown);
    return std::move(next_);
  }
  return sequence_.read(static_cast<std::size_t>(number));
}

void Playback::read_ahead(int number) {
  if (kept_.contains(number)) return;
  if (!ahead_) ahead_.emplace();
  if (ahead_->has_work()) return;
  next_number_ = number;
  ahead_->offer([this] { next_ = sequence_.read(static_cast<std::size_t>(next_number_)); });
}

void Playback::release() {
  ahead_.reset();
  next_ = {};
  for (auto next = std::next(kept_.begin()); next != kept_.end(); next = kept_.erase(next))
    free_bytes_ += bytes_of(*next->second);
}

/// Makes models of bodies that no frame had before. Bodies of one mesh share a model.
std::shared_ptr<const RecordedFrame> Playback::record(int number, SequenceFrame frame) {
  const glm::dvec3& origin = sequence_.origin();
  for (const auto& [axis, zero] : {std::pair(&frame.at.x, origin.x), {&frame.at.y, origin.y}, {&frame.at.z, origin.z}})
    for (const float at : *axis)
      if (const double in_file = double{at} + zero; !(std::abs(in_file) <= max_coordinate))
        throw softbody::SceneError(fmt::format("{}: a coordinate of {:g}; they must lie within {:g} to be played",
                                               sequence_.file(static_cast<std::size_t>(number)).string(), in_file,
                                               max_coordinate));
  const SequenceBodies& of = *frame.of;
  std::uint32_t count = 0;
  for (std::size_t body = 0; body < of.meshes.count(); ++body) {
    if (of.meshes.size(body) == 0) continue;
    const auto& shape = of.bodies.shape[body];
    if (count == models_.size()) {
      std::vector<softbody::Triangle> triangles = triangles_of(of.meshes, body, frame.at);
      models_.push_back(
          !models_.empty() && suits(*models_.back(), *shape, triangles)
              ? models_.back()
              : softbody::recorded_body_model(mesh_of(of.meshes, body, frame.at, std::move(triangles)), shape));
    } else if (const collide::Shape& known = *models_[count]->shape;
               known.shared_topology() != shape->shared_topology() && known.topology() != shape->topology()) {
      throw softbody::SceneError(sequence_.file(static_cast<std::size_t>(number)).string() + ": body " +
                                 std::to_string(body) +
                                 " is another one than in an earlier frame; give frames of the same bodies");
    }
    ++count;
  }
  return std::make_shared<RecordedFrame>(RecordedFrame{std::move(frame.at), count});
}

float Playback::usual_tolerance() {
  const std::shared_ptr<const RecordedFrame> first = frame(0);
  std::vector<float> lengths;
  std::size_t begin = 0;
  for (std::uint32_t body = 0; body < first->body_count; ++body) {
    const auto at = [&](softbody::Index v) { return softbody::ConstPoints(*first)[begin + v]; };
    for (const auto& [a, b] : models_[body]->mesh.edges) lengths.push_back(glm::distance(at(a), at(b)));
    begin += models_[body]->mesh.vertices.size();
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  const float tolerance = lengths.empty() ? 0.01f * glm::distance(bounds()[0], bounds()[1]) : 0.5f * *middle;
  return std::clamp(tolerance, collide::min_tolerance, collide::max_tolerance);
}

Opened open_recording(const std::vector<std::filesystem::path>& files, std::optional<BodiesBy> by) {
  const std::optional<softbody::Scene> around = scene_around(files.front());
  const auto playback = std::make_shared<Playback>(files, by, Playback::max_kept_bytes, around.has_value());
  softbody::Scene scene = around.value_or(softbody::Scene());
  scene.bodies.clear();  // they are in the frames
  scene.dropper.reset();
  scene.captions.clear();
  scene.key = std::filesystem::absolute(files.front()).string();
  scene.name = files.front().filename().string();
  scene.look_at = fmt::format("{} recorded frames, from {} to {}. Nothing is simulated.", files.size(),
                              files.front().filename().string(), files.back().filename().string());
  if (around) return {std::move(scene), playback};
  scene.collision.tolerance = playback->usual_tolerance();
  const auto bounds = playback->bounds();
  const glm::dvec3 low(bounds[0]), high(bounds[1]);
  scene.view.target = 0.5 * (low + high);
  constexpr double diameters = 1.46;  // from there a sphere just fits into the camera's field of view, 0.7 radians
  scene.view.distance = std::max(diameters * glm::distance(low, high), 1e-4);
  return {std::move(scene), playback};
}

}  // namespace app::files
