#pragma once
// Bodies in motion that the search for surface contact is tried on.

#include <glm/geometric.hpp>

#include "collide/surface/surface_search.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;

/// Bodies that move, and what is asked about them.
struct Moving {
  Scene scene;
  std::vector<glm::vec3> velocity;  // m/s, of every vertex
  std::vector<SurfaceBody> traits;
  float seconds = 0.05f;
  bool whole = true;  // is foreseen for all of them, however fast it is strained

  /// velocity_of(position seen from the body's middle): m/s.
  template <class Velocity>
  void add(const SurfaceMesh& mesh, const glm::vec3& at, float reach, float slack, const Velocity& velocity_of) {
    scene.add(moved(mesh, at));
    for (const glm::vec3& v : mesh.vertices) velocity.push_back(velocity_of(v));
    traits.push_back({scene.surfaces.back().get(), reach + slack, slack, 0.3f, true});
  }
  Index first(Index body) const { return scene.state.bodies.first[body]; }
  /// Where all vertices are after `time`, each off its path by up to its body's slack.
  Scene after(float time, std::mt19937& random) const;
};

inline Scene Moving::after(float time, std::mt19937& random) const {
  Scene later = scene;
  for (Index body = 0; body < traits.size(); ++body)
    for (Index v = first(body); v < first(body + 1); ++v) {
      const glm::vec3 way = random_points(random, 1, -1, 1)[0], u = traits[body].moves ? velocity[v] : glm::vec3(0);
      const glm::vec3 stray = 0.999f * traits[body].slack * way / std::max(1e-3f, glm::length(way));
      const glm::vec3 x = scene.at(v) + time * u + (traits[body].moves ? stray : glm::vec3(0));
      later.state.x[v] = x.x, later.state.y[v] = x.y, later.state.z[v] = x.z;
    }
  return later;
}

struct Found {
  SurfaceSearch search;
  std::vector<float> vx, vy, vz;
  Found(const Moving& m, bool self, int threads = 1) {
    for (const glm::vec3& v : m.velocity) vx.push_back(v.x), vy.push_back(v.y), vz.push_back(v.z);
    Workers workers(threads);
    search.find({m.scene.frame(), vx, vy, vz}, m.traits, {m.seconds, m.whole ? m.seconds : 0.0f, self}, workers);
  }
};

/// Five bodies close to each other, round, dented and flat, some of which stand; they fly, turn, and are strained.
inline Moving swarm(std::mt19937& random, float speed, float reach, float slack) {
  Moving m;
  for (Index body = 0; body < 5; ++body) {
    SurfaceMesh mesh = body == 3 ? sheet(6, 1.5f) : body == 4 ? box(glm::vec3(-0.4f), glm::vec3(0.3f)) : ball(0.5f, 1);
    if (body == 2)
      for (glm::vec3& v : mesh.vertices) v *= uniform(random, 0.4f, 1.2f);
    const std::vector<glm::vec3> r = random_points(random, 3, -1, 1);
    mesh = turned(mesh, r[0], uniform(random, 0, 6));
    const glm::vec3 at = 0.8f * r[1], fly = speed * r[2] - at / m.seconds * uniform(random, 0, 1),
                    spin = uniform(random, 0, speed) * r[0];
    m.add(mesh, at, reach, slack, [&](const glm::vec3& v) {
      return fly + glm::cross(spin, v) + 0.2f * speed * random_points(random, 1, -1, 1)[0];
    });
  }
  m.traits[random() % 5].moves = false;
  return m;
}

}  // namespace collide::test
