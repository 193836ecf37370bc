#pragma once
/* Worlds of soft bodies for C and for languages that call C. <sbcollide/softbody.h> says what its terms mean, and
   <sbcollide/collide_c.h> what holds for all functions of the C interface.

   A handle first collects a scene. sbcollide_world_start() makes a world of it. What is read before is empty. */

#include <sbcollide/collide_c.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sbcollide_world sbcollide_world;

/* Returns a handle with an empty scene; NULL if there is not enough memory. */
sbcollide_world* sbcollide_world_new(void);
void sbcollide_world_free(sbcollide_world* world); /* NULL is allowed */
/* Returns why the last call failed; "" if it did not. Valid until the next call. */
const char* sbcollide_world_error(const sbcollide_world* world);

/* Replaces the scene by that of a scene file. */
sbcollide_status sbcollide_world_load(sbcollide_world* world, const char* scene_file);
/* Replaces the scene by an empty one that takes presets of materials from that file. */
sbcollide_status sbcollide_world_clear(sbcollide_world* world, const char* materials_file);
/* Adds tables as scene files have them: materials, solids, bodies, ground ... */
sbcollide_status sbcollide_world_add_text(sbcollide_world* world, const char* toml);
/* Adds a mesh for bodies and writes its number to *mesh. xyz: three coordinates of each vertex; triangles: three
   vertices each. */
sbcollide_status sbcollide_world_add_mesh(sbcollide_world* world, const float* xyz, size_t vertex_count,
                                          const uint32_t* triangles, size_t triangle_count, int* mesh);
/* Does the same, and says by about how many particles the mesh is simulated if it has more vertices: 50 or more. 0: as
   sbcollide_world_add_mesh(), by 800 if it has more than 1,000. */
sbcollide_status sbcollide_world_add_fine_mesh(sbcollide_world* world, const float* xyz, size_t vertex_count,
                                               const uint32_t* triangles, size_t triangle_count, int resolution,
                                               int* mesh);
sbcollide_status sbcollide_world_add_sphere_mesh(sbcollide_world* world, double radius, int subdivisions, int* mesh);
/* Adds a body; once the world is started, at once. material: a name, or NULL for the first one. position (m), velocity
   (m/s): three numbers each, or NULL for zeros. */
sbcollide_status sbcollide_world_add_body(sbcollide_world* world, int mesh, const char* material,
                                          const double* position, const double* velocity);

/* Makes a world of the scene, in place of one that the handle has. threads: 0 for all cores. integrator: a key, or NULL
   for "auto". */
sbcollide_status sbcollide_world_start(sbcollide_world* world, int threads, const char* integrator);
/* Simulates frames of 1/60 s. Fails before the start. */
sbcollide_status sbcollide_world_step(sbcollide_world* world, int frames);

/* The state at the end of the last step. Pointers are valid until the next call of a function that returns a status. */
int sbcollide_world_frame(const sbcollide_world* world);
double sbcollide_world_time(const sbcollide_world* world);
uint32_t sbcollide_world_bodies(const sbcollide_world* world);
uint32_t sbcollide_world_vertices(const sbcollide_world* world);
/* Returns the first vertex of a body; for a body that does not exist, the number of vertices. */
uint32_t sbcollide_world_first_vertex(const sbcollide_world* world, uint32_t body);
/* One coordinate for each vertex. */
const float* sbcollide_world_x(const sbcollide_world* world);
const float* sbcollide_world_y(const sbcollide_world* world);
const float* sbcollide_world_z(const sbcollide_world* world);
/* Copies three numbers for each vertex, in m/s. */
sbcollide_status sbcollide_world_velocities(sbcollide_world* world, double* xyz);
size_t sbcollide_world_contact_count(const sbcollide_world* world);
const sbcollide_contact* sbcollide_world_contacts(const sbcollide_world* world); /* NULL if there is none */
double sbcollide_world_energy(const sbcollide_world* world);                     /* J */
uint64_t sbcollide_world_state_hash(const sbcollide_world* world);

#ifdef __cplusplus
}
#endif
