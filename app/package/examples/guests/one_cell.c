/* A hash grid WITH A MISTAKE, to see how a mistake looks: it looks only into the cell of the vertex itself, and not
   into the 26 cells around it. So it misses each pair that has a face of a cell between its vertices. hash_grid.c is
   right. */
#include <math.h>
#include <stdlib.h>

#include <sbcollide/method.h>

#define LISTS 65536u
#define NONE UINT32_MAX

typedef struct {
  uint32_t first[LISTS]; /* vertex of each list, or NONE */
  uint32_t* next;        /* of each vertex: the next one in its list, or NONE */
  uint32_t room;         /* number of vertices that next has room for */
} grid;

static void* make(void) { return calloc(1, sizeof(grid)); }

static void destroy(void* self) {
  free(((grid*)self)->next);
  free(self);
}

/* Returns the list of a cell. Cells may share a list: the distance decides. */
static uint32_t list_of(int64_t i, int64_t j, int64_t k) {
  const uint64_t hash = (uint64_t)i * 73856093u ^ (uint64_t)j * 19349663u ^ (uint64_t)k * 83492791u;
  return (uint32_t)(hash % LISTS);
}

static void find(void* self, const sbcollide_frame* frame, float tolerance, sbcollide_pairs* pairs) {
  grid* g = (grid*)self;
  const float *x = frame->x, *y = frame->y, *z = frame->z;
  const double side = 1.0001 * tolerance; /* a little longer: numbers are rounded */
  if (frame->vertex_count > g->room) {
    g->room = frame->vertex_count;
    g->next = (uint32_t*)realloc(g->next, g->room * sizeof(uint32_t));
  }
  for (uint32_t list = 0; list < LISTS; ++list) g->first[list] = NONE;
  for (uint32_t b = 0; b < frame->vertex_count; ++b) {
    const int64_t i = (int64_t)floor(x[b] / side), j = (int64_t)floor(y[b] / side), k = (int64_t)floor(z[b] / side);
    const uint32_t list = list_of(i, j, k);
    for (uint32_t a = g->first[list]; a != NONE;
         a = g->next[a]) { /* the vertices before b in the cell of b: the mistake */
      const float dx = x[a] - x[b], dy = y[a] - y[b], dz = z[a] - z[b];
      if (dx * dx + dy * dy + dz * dz < tolerance * tolerance) sbcollide_add(pairs, a, b);
    }
    g->next[b] = g->first[list];
    g->first[list] = b;
  }
}

const sbcollide_method* sbcollide_guest(void) {
  static const sbcollide_method method = {SBCOLLIDE_METHOD_VERSION,
                                          "my-mistake",
                                          "My mistake",
                                          "Tests vertices in the same cell only.",
                                          make,
                                          find,
                                          destroy};
  return &method;
}
