#include "softbody/api/sbcollide/softbody_c.h"

#include <optional>

#include "collide/api/guarded.h"
#include "softbody/api/sbcollide/softbody.h"

using sbcollide::Error;
using sbcollide::guarded;
using sbcollide::require_pointer;

struct sbcollide_world {
  sbcollide::Scene scene;
  std::optional<sbcollide::World> world;
  std::string error;

  sbcollide::World& started() {
    if (!world) throw Error("there is no world yet; call sbcollide_world_start()");
    return *world;
  }
  sbcollide::Positions positions() const { return world ? world->positions() : sbcollide::Positions{}; }
  std::span<const sbcollide::Contact> contacts() const {
    return world ? world->contacts() : std::span<const sbcollide::Contact>{};
  }
};

sbcollide_world* sbcollide_world_new(void) { return sbcollide::made<sbcollide_world>(); }

void sbcollide_world_free(sbcollide_world* world) { delete world; }

const char* sbcollide_world_error(const sbcollide_world* world) { return world->error.c_str(); }

sbcollide_status sbcollide_world_load(sbcollide_world* world, const char* scene_file) {
  return guarded(world, [&] {
    require_pointer(scene_file, 1, "scene_file");
    world->scene = sbcollide::Scene::from_file(scene_file);
  });
}

sbcollide_status sbcollide_world_clear(sbcollide_world* world, const char* materials_file) {
  return guarded(world, [&] { world->scene = sbcollide::Scene(materials_file ? materials_file : ""); });
}

sbcollide_status sbcollide_world_add_text(sbcollide_world* world, const char* toml) {
  return guarded(world, [&] {
    require_pointer(toml, 1, "toml");
    world->scene.add_text(toml);
  });
}

sbcollide_status sbcollide_world_add_mesh(sbcollide_world* world, const float* xyz, size_t vertex_count,
                                          const uint32_t* triangles, size_t triangle_count, int* mesh) {
  return sbcollide_world_add_fine_mesh(world, xyz, vertex_count, triangles, triangle_count, 0, mesh);
}

sbcollide_status sbcollide_world_add_fine_mesh(sbcollide_world* world, const float* xyz, size_t vertex_count,
                                               const uint32_t* triangles, size_t triangle_count, int resolution,
                                               int* mesh) {
  return guarded(world, [&] {
    require_pointer(xyz, vertex_count, "xyz");
    const auto corners = sbcollide::groups_at<3>(triangles, triangle_count, "triangles");
    require_pointer(mesh, 1, "mesh");
    *mesh = world->scene.add_mesh({xyz, 3 * vertex_count}, corners, resolution);
  });
}

sbcollide_status sbcollide_world_add_sphere_mesh(sbcollide_world* world, double radius, int subdivisions, int* mesh) {
  return guarded(world, [&] {
    require_pointer(mesh, 1, "mesh");
    *mesh = world->scene.add_sphere_mesh(radius, subdivisions);
  });
}

sbcollide_status sbcollide_world_add_body(sbcollide_world* world, int mesh, const char* material,
                                          const double* position, const double* velocity) {
  return guarded(world, [&] {
    sbcollide::Body body{.mesh = mesh, .material = material ? material : ""};
    if (position) body.position = {position[0], position[1], position[2]};
    if (velocity) body.velocity = {velocity[0], velocity[1], velocity[2]};
    if (world->world)
      world->world->add_body(body);
    else
      world->scene.add_body(body);
  });
}

sbcollide_status sbcollide_world_start(sbcollide_world* world, int threads, const char* integrator) {
  return guarded(world, [&] {
    sbcollide::WorldSettings settings{.threads = threads};
    if (integrator) settings.integrator = integrator;
    world->world = sbcollide::World(world->scene, settings);
  });
}

sbcollide_status sbcollide_world_step(sbcollide_world* world, int frames) {
  return guarded(world, [&] {
    sbcollide::World& started = world->started();
    for (int i = 0; i < frames; ++i) started.step();
  });
}

int sbcollide_world_frame(const sbcollide_world* world) { return world->world ? world->world->frame() : 0; }
double sbcollide_world_time(const sbcollide_world* world) { return world->world ? world->world->time() : 0; }
uint32_t sbcollide_world_bodies(const sbcollide_world* world) { return world->world ? world->world->bodies() : 0; }

uint32_t sbcollide_world_vertices(const sbcollide_world* world) {
  return static_cast<uint32_t>(world->positions().x.size());
}

uint32_t sbcollide_world_first_vertex(const sbcollide_world* world, uint32_t body) {
  return body < sbcollide_world_bodies(world) ? world->world->first_vertex(body) : sbcollide_world_vertices(world);
}

const float* sbcollide_world_x(const sbcollide_world* world) { return world->positions().x.data(); }
const float* sbcollide_world_y(const sbcollide_world* world) { return world->positions().y.data(); }
const float* sbcollide_world_z(const sbcollide_world* world) { return world->positions().z.data(); }

sbcollide_status sbcollide_world_velocities(sbcollide_world* world, double* xyz) {
  return guarded(world, [&] {
    require_pointer(xyz, 1, "xyz");
    for (const sbcollide::Vector& v : world->started().velocities()) xyz = std::copy(v.begin(), v.end(), xyz);
  });
}

size_t sbcollide_world_contact_count(const sbcollide_world* world) { return world->contacts().size(); }

const sbcollide_contact* sbcollide_world_contacts(const sbcollide_world* world) {
  return reinterpret_cast<const sbcollide_contact*>(world->contacts().data());
}

double sbcollide_world_energy(const sbcollide_world* world) {
  return world->world ? world->world->energies().total() : 0;
}

uint64_t sbcollide_world_state_hash(const sbcollide_world* world) {
  return world->world ? world->world->state_hash() : 0;
}
