#pragma once
/* A collision detector of your own, which sbcollide compares with its methods: write it in C (C99) or C++, and run
   `sbcollide --guest FILE`. FILE is a source (.c, .cpp), which sbcollide compiles, or a library (.so).

   The detector runs in a process of its own, on one thread. If it crashes or takes too long, sbcollide says so and goes
   on. */

#include <stddef.h>
#include <stdint.h>

#define SBCOLLIDE_METHOD_VERSION 1

#ifdef _WIN32
#define SBCOLLIDE_EXPORT __declspec(dllexport)
#else
#define SBCOLLIDE_EXPORT __attribute__((visibility("default")))
#endif
#ifdef __cplusplus
#define SBCOLLIDE_GUEST extern "C" SBCOLLIDE_EXPORT
#else
#define SBCOLLIDE_GUEST SBCOLLIDE_EXPORT
#endif

/* One frame. It can only be read, and only until find() returns. Vertices are numbered over all bodies. */
typedef struct {
  uint32_t vertex_count, body_count, edge_count, triangle_count;
  const float *x, *y, *z;       /* m; vertex_count each */
  const uint32_t* first_vertex; /* of each body, and one more at the end: body b has the vertices first_vertex[b] to
                                   first_vertex[b + 1] - 1 */
  const uint32_t* edges;        /* of the meshes: 2 * edge_count vertices; edge_count is 0 if the frame has none */
  const uint32_t* triangles;    /* 3 * triangle_count vertices; triangle_count is 0 if the frame has none */
} sbcollide_frame;

/* Where find() puts the pairs that it finds. Its members are for sbcollide_add() only. */
typedef struct sbcollide_pairs sbcollide_pairs;
struct sbcollide_pairs {
  uint32_t *next, *end;                      /* the place of the next pair; where the room ends */
  void (*make_room)(sbcollide_pairs* pairs); /* does not return if there are too many pairs */
};

/* Hands over a pair of vertices that are closer than the tolerance. Pairs may come in any order, and also twice. Hand
   over pairs joined by an edge, too, or close at rest: sbcollide knows which of them do not count. A pair that is not
   closer than the tolerance counts against the precision of the method. A vertex that does not exist is an error. */
static inline void sbcollide_add(sbcollide_pairs* pairs, uint32_t a, uint32_t b) {
  if (pairs->next == pairs->end) pairs->make_room(pairs);
  pairs->next[0] = a;
  pairs->next[1] = b;
  pairs->next += 2;
}

typedef struct {
  uint32_t version;    /* SBCOLLIDE_METHOD_VERSION */
  const char* key;     /* on the command line: letters, digits and hyphens, e.g. "my-grid" */
  const char* name;    /* in tables, e.g. "My grid" */
  const char* summary; /* one sentence */
  void* (*make)(void); /* returns `self` of the other functions, which keeps data from frame to frame; or NULL */
  /* Hands over all pairs that are closer than the tolerance (m). Only this function is timed. */
  void (*find)(void* self, const sbcollide_frame* frame, float tolerance, sbcollide_pairs* pairs);
  void (*destroy)(void* self); /* or NULL */
} sbcollide_method;

/* What a guest defines: it returns its method, which must stay valid. */
SBCOLLIDE_GUEST const sbcollide_method* sbcollide_guest(void);
