#include "app/report/worlds.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"

namespace app::report {

softbody::Material ball_material(double stiffness, double damping_ratio) {
  softbody::Material m;
  m.name = "ball";
  m.set(softbody::StructuralSprings::keys, {stiffness, damping_ratio});
  m.set(softbody::BendSprings::keys, {stiffness / 4, damping_ratio});
  m[softbody::GasPressure::inside] = 1.6 * stiffness;
  m[softbody::contact::rolling_resistance] = 0;
  return m;
}

softbody::Scene lone_scene(const softbody::Material& material) {
  softbody::Scene scene;
  scene.gravity = glm::dvec3(0.0);
  scene.collision.self_collision = false;
  scene.sleep.speed = 0;
  scene.materials = {material};
  softbody::BodySource& body = scene.bodies.emplace_back();
  body.position = glm::dvec3(0.0);
  return scene;
}

softbody::IntegratorChoice with_steps(const softbody::Integrator& integrator, int steps) {
  return {std::string(integrator.key), integrator.automatic || steps == 0 ? std::nullopt : std::optional(steps)};
}

softbody::World start_world(softbody::Scene scene, const softbody::World::Options& options,
                            const std::vector<Particles>& start) {
  softbody::World world(std::move(scene), options);
  for (softbody::BodyId b = 0; b < start.size(); ++b) world.set_particles(b, start[b]);
  return world;
}

Particles particles_of(const softbody::World& world, softbody::BodyId body) {
  Particles list;
  for (softbody::Index i = 0; i < world.model(body).mesh.vertices.size(); ++i) list.push_back(world.particle(body, i));
  return list;
}

std::vector<Particles> all_particles(const softbody::World& world) {
  std::vector<Particles> list;
  for (softbody::BodyId b = 0; b < world.bodies().count(); ++b) list.push_back(particles_of(world, b));
  return list;
}

std::vector<Particles> changed_start(const softbody::Scene& scene,
                                     const std::function<void(softbody::Particle&)>& change) {
  Particles start = particles_of(world_of(scene), 0);
  for (softbody::Particle& p : start) change(p);
  return {std::move(start)};
}

glm::dvec3 middle_of(const collide::Frame& at, collide::Index begin, collide::Index end) {
  glm::dvec3 sum{0.0};
  for (collide::Index v = begin; v < end; ++v) sum += glm::dvec3(at.x[v], at.y[v], at.z[v]);
  return sum / std::max(1.0, double(end - begin));
}

softbody::MeshSource source_of(softbody::Mesh mesh) {
  auto imported = std::make_shared<softbody::ImportedMesh>();
  imported->mesh = std::move(mesh);
  return {.kind = "file", .file = {}, .imported = std::move(imported)};
}

void require_whole_frame(const softbody::World& world) {
  if (world.last_step().seconds < world.frame_time())
    throw softbody::SceneError("a frame would take more work than there may be");
}

}  // namespace app::report
