#pragma once
/* The finder of contacts for C and for languages that call C. <sbcollide/collide.h> says what its terms mean.

   A function that returns a status throws nothing and never ends the program. If it fails, the handle keeps one line
   that says why, and stays usable. Each handle may be used by one thread at a time. No pointer may be NULL unless this
   file says so. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum sbcollide_status {
  SBCOLLIDE_OK = 0,
  SBCOLLIDE_ERROR = 1, /* see sbcollide_finder_error() or sbcollide_world_error() */
  SBCOLLIDE_OUT_OF_MEMORY = 2
} sbcollide_status;

/* A pair of vertices a < b, numbered over all bodies. */
typedef struct sbcollide_contact {
  uint32_t a, b;
} sbcollide_contact;

/* Returns "MAJOR.MINOR.PATCH". */
const char* sbcollide_version(void);

typedef struct sbcollide_finder sbcollide_finder;

/* Returns a finder with the default settings and no body; NULL if there is not enough memory. */
sbcollide_finder* sbcollide_finder_new(void);
void sbcollide_finder_free(sbcollide_finder* finder); /* NULL is allowed */
/* Returns why the last call failed; "" if it did not. Valid until the next call. */
const char* sbcollide_finder_error(const sbcollide_finder* finder);

typedef enum sbcollide_finder_setting {
  SBCOLLIDE_TOLERANCE = 0,
  SBCOLLIDE_SELF_COLLISION = 1, /* 0 or 1 */
  SBCOLLIDE_THREADS = 2,
  SBCOLLIDE_LEVELS = 3,
  SBCOLLIDE_BUCKETS = 4,
  SBCOLLIDE_CELL_SIZE = 5 /* of all three sides */
} sbcollide_finder_setting;
/* These two keep the bodies, and forget the frame before. */
sbcollide_status sbcollide_finder_set(sbcollide_finder* finder, sbcollide_finder_setting setting, double value);
sbcollide_status sbcollide_finder_set_method(sbcollide_finder* finder, const char* key);

/* Adds a body. triangles: three vertices each; edges: two each; rest: x, y, z of each vertex. All three are copied, and
   each may be NULL. */
sbcollide_status sbcollide_finder_add_body(sbcollide_finder* finder, uint32_t vertices, const uint32_t* triangles,
                                           size_t triangle_count, const uint32_t* edges, size_t edge_count,
                                           const float* rest);
sbcollide_status sbcollide_finder_clear_bodies(sbcollide_finder* finder);
uint32_t sbcollide_finder_vertices(const sbcollide_finder* finder); /* of all bodies */

/* Finds the contacts. x, y, z: one coordinate each for every vertex. */
sbcollide_status sbcollide_finder_find(sbcollide_finder* finder, const float* x, const float* y, const float* z);
/* The same for positions that are written x, y, z, x, y, z ... */
sbcollide_status sbcollide_finder_find_interleaved(sbcollide_finder* finder, const float* xyz);

/* What the last call has found; none if it failed. Pointers are valid until the next call. */
size_t sbcollide_finder_contact_count(const sbcollide_finder* finder);
const sbcollide_contact* sbcollide_finder_contacts(const sbcollide_finder* finder); /* NULL if there is none */
size_t sbcollide_finder_non_finite_count(const sbcollide_finder* finder);
const uint32_t* sbcollide_finder_non_finite_bodies(const sbcollide_finder* finder); /* NULL if there is none */

#ifdef __cplusplus
}
#endif
