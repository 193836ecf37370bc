#include <glm/geometric.hpp>

#include "app/files/inputs.h"
#include "app/reference/body_shape.h"
#include "app/report/files.h"
#include "app/report/solver/results.h"
#include "softbody/world/world.h"

namespace app::report {
namespace {

constexpr int fall_frames = 60, frames_between_looks = 5;

/// Returns the creature of the scene over a solid sphere, by contact of surfaces.
softbody::Scene creature() {
  softbody::Scene scene = softbody::find_scene("shapes", files::scene_folder());
  const auto is_creature = [](const softbody::BodySource& body) { return body.mesh.file.path.stem() == "creature"; };
  scene.bodies = {*std::ranges::find_if(scene.bodies, is_creature)};
  scene.bodies[0].position = {0.05, 2.7, 0.1};
  scene.captions.clear();
  scene.method = "sorted-grid";
  return scene;
}

/// The vertices that are shown, about their middle, at one look.
struct Look {
  glm::dvec3 middle{0.0};
  std::vector<glm::dvec3> about;
};

Look look_at(const softbody::World& world) {
  const collide::Frame at = world.positions();
  Look look{middle_of(at, 0, at.bodies->vertex_count()), {}};
  for (std::size_t v = 0; v < at.x.size(); ++v)
    look.about.push_back(glm::dvec3(at.x[v], at.y[v], at.z[v]) - look.middle);
  return look;
}

/// The fall of the creature in one resolution.
struct Fall {
  softbody::Scene scene;
  std::vector<Look> looks{};
  Timings solving{};  // by repetition

  void repeat() {
    softbody::World world(scene, {});
    looks.clear();
    double& ms = solving.ms.emplace_back(0);
    for (int frame = 1; frame <= fall_frames; ++frame) {
      world.step();
      ms += world.last_step().solve_ms;
      if (frame % frames_between_looks == 0) looks.push_back(look_at(world));
    }
  }
};

}  // namespace

CoarseResults measure_coarse(bool quick) {
  softbody::Scene scene = creature();
  softbody::MeshFile file = scene.bodies[0].mesh.file;
  const std::size_t vertices = scene.bodies[0].mesh.vertex_count();
  std::vector<std::size_t> resolutions{200, 400, 800, 1600, 3200, vertices};
  if (quick) resolutions = {400, 800, 3200};
  std::vector<Fall> falls;
  for (const std::size_t resolution : resolutions) {
    file.resolution = resolution;
    scene.bodies[0].mesh = softbody::MeshSource::from_file(file);
    falls.push_back({scene});
  }
  const std::size_t repetitions = quick ? 1 : 3, all = repetitions * falls.size();
  for (std::size_t i = 0; i < all; ++i) {
    say("Coarse meshes", double(i) / double(all));
    falls[i % falls.size()].repeat();
  }
  CoarseResults results{.vertices = vertices};
  for (const Fall& fall : falls) {
    const softbody::ImportedMesh& mesh = *fall.scene.bodies[0].mesh.imported;
    const double radius = softbody::bounding_radius(mesh.mesh);
    double middle = 0, shape = 0;  // R
    for (std::size_t k = 0; k < fall.looks.size(); ++k) {
      const Look &here = fall.looks[k], &finest = falls.back().looks[k];
      middle = std::max(middle, glm::distance(here.middle, finest.middle) / radius);
      shape = std::max(shape, reference::rms_distance(here.about, finest.about) / radius);
    }
    const double apart = mesh.coarse ? mesh.coarse->distance : 0;
    results.runs.add({{"particles", whole(double(mesh.simulated().vertices.size()))},
                      {"surfaces apart, R", when(mesh.coarse.has_value(), fmt::format("{:.2g}", apart / radius))},
                      {"middle, R", fmt::format("{:.2g}", middle)},
                      {"shape, R", fmt::format("{:.2g}", shape)},
                      {"run time", fmt::format("{:.2g}", fall.solving.median() / falls.back().solving.median())}});
  }
  return results;
}

}  // namespace app::report
