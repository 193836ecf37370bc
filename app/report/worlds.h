#pragma once
// Worlds as the reports begin them: bodies in balance or moved out of it, and prescribed steps.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "softbody/world/world.h"

namespace app::report {

using Particles = std::vector<softbody::Particle>;

/// Returns a material of 1 kg: springs of k N/m, bend springs of k / 4, and gas, without ambient pressure, that
/// inflates an icosphere by an eighth whatever k is. Only the springs damp.
softbody::Material ball_material(double stiffness, double damping_ratio);

/// Returns a scene of one body, at rest in balance at the origin, without gravity, solids and sleep.
softbody::Scene lone_scene(const softbody::Material& material);

/// Returns the integrator with that number of steps per frame. It chooses its own if it is `auto`, or `steps` is 0.
softbody::IntegratorChoice with_steps(const softbody::Integrator& integrator, int steps);

/// Returns the integrator with one step per frame, with which no scene is refused.
inline softbody::IntegratorChoice one_step(std::string_view key = softbody::default_integrator) {
  return {std::string(key), 1};
}
/// Returns the scene's world with that.
inline softbody::World world_of(const softbody::Scene& scene) { return {scene, {.integrator = one_step()}}; }

/// Returns a world whose first bodies have these particles; the others start as the scene has them.
softbody::World start_world(softbody::Scene scene, const softbody::World::Options& options,
                            const std::vector<Particles>& start);

/// Returns the particles of a body of the world.
Particles particles_of(const softbody::World& world, softbody::BodyId body);
/// Returns the particles of each body.
std::vector<Particles> all_particles(const softbody::World& world);
/// Returns those of the scene's only body, each changed from where it is in balance.
std::vector<Particles> changed_start(const softbody::Scene& scene,
                                     const std::function<void(softbody::Particle&)>& change);

/// Returns the mean of some vertices (m).
glm::dvec3 middle_of(const collide::Frame& at, collide::Index begin, collide::Index end);
/// Returns the mean of a body's.
inline glm::dvec3 middle_of(const collide::Frame& at, collide::Index body) {
  return middle_of(at, at.bodies->first[body], at.bodies->first[body + 1]);
}
/// Returns the source of a body with this mesh, as if from a file.
softbody::MeshSource source_of(softbody::Mesh mesh);

/// Throws SceneError if only a part of the last frame was simulated (see StepReport): figures are of whole
/// frames.
void require_whole_frame(const softbody::World& world);

}  // namespace app::report
