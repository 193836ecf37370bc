#pragma once
// Moving bodies for the tests of the search for surface contact.

#include <glm/geometric.hpp>

#include "collide/surface/surface_search.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;

/// Bodies with velocities, and the arguments of a search.
struct MovingScene {
  Scene scene;
  std::vector<glm::vec3> velocity;  // m/s, of every vertex
  std::vector<SurfaceBody> traits;
  float seconds = 0.05f;
  bool whole = true;  // the motion is predicted for all of `seconds`, even if the deformation is fast

  /// Adds a body at `at`. velocity_of(position relative to `at`): m/s.
  template <class Velocity>
  void add(const SurfaceMesh& mesh, const glm::vec3& at, float contact_offset, float slack,
           const Velocity& velocity_of) {
    scene.add(moved(mesh, at));
    for (const glm::vec3& v : mesh.vertices) velocity.push_back(velocity_of(v));
    traits.push_back({scene.surfaces.back().get(), contact_offset + slack, slack, 0.3f, true});
  }
  Index first(Index body) const { return scene.state.bodies.first[body]; }
  /// Returns the bodies after `time`; each vertex deviates from its path by up to the slack of its body.
  Scene after(float time, std::mt19937& random) const;
};

inline Scene MovingScene::after(float time, std::mt19937& random) const {
  Scene later = scene;
  for (Index body = 0; body < traits.size(); ++body)
    for (Index v = first(body); v < first(body + 1); ++v) {
      const glm::vec3 direction = random_points(random, 1, -1, 1)[0],
                      u = traits[body].moves ? velocity[v] : glm::vec3(0);
      const glm::vec3 deviation = 0.999f * traits[body].slack * direction / std::max(1e-3f, glm::length(direction));
      const glm::vec3 x = scene.at(v) + time * u + (traits[body].moves ? deviation : glm::vec3(0));
      later.state.x[v] = x.x, later.state.y[v] = x.y, later.state.z[v] = x.z;
    }
  return later;
}

/// The velocity of what is at rest.
inline glm::vec3 still(const glm::vec3&) { return glm::vec3(0); }

/// A search, after find().
struct SearchRun {
  SurfaceSearch search;
  std::vector<float> vx, vy, vz;
  SearchRun(const MovingScene& m, bool self, int threads = 1) {
    for (const glm::vec3& v : m.velocity) vx.push_back(v.x), vy.push_back(v.y), vz.push_back(v.z);
    Workers workers(threads, 0);
    search.find({m.scene.frame(), vx, vy, vz}, m.traits, {m.seconds, m.whole ? m.seconds : 0.0f, self}, workers);
  }
};

/// Returns five bodies close to each other: round, dented and flat ones. They move, rotate and deform; one is at rest.
inline MovingScene swarm(std::mt19937& random, float speed, float contact_offset, float slack) {
  MovingScene m;
  for (Index body = 0; body < 5; ++body) {
    SurfaceMesh mesh = body == 3 ? sheet(6, 1.5f) : body == 4 ? box(glm::vec3(-0.4f), glm::vec3(0.3f)) : ball(0.5f, 1);
    if (body == 2)
      for (glm::vec3& v : mesh.vertices) v *= uniform(random, 0.4f, 1.2f);
    const std::vector<glm::vec3> r = random_points(random, 3, -1, 1);
    mesh = turned(mesh, r[0], uniform(random, 0, 6));
    const glm::vec3 at = 0.8f * r[1], fly = speed * r[2] - at / m.seconds * uniform(random, 0, 1),
                    spin = uniform(random, 0, speed) * r[0];
    m.add(mesh, at, contact_offset, slack, [&](const glm::vec3& v) {
      return fly + glm::cross(spin, v) + 0.2f * speed * random_points(random, 1, -1, 1)[0];
    });
  }
  m.traits[random() % 5].moves = false;
  return m;
}

}  // namespace collide::test
