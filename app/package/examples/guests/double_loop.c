/* A detector of your own: a double loop over all vertices. It is right, and slow.

   See it beside the methods of sbcollide, on the same frames:
     sbcollide --guest FILE
   Then change it. sbcollide compiles the file again whenever you save it. */
#include <sbcollide/method.h>

/* Hands over each pair of vertices that are closer than the tolerance (m).
   self: what make() returned; here NULL.
   frame: the positions of all vertices, frame->x[i], frame->y[i], frame->z[i] (m). You can only read them.
   Pairs that do not count, such as two ends of an edge, need no care: sbcollide leaves them out. */
static void find(void* self, const sbcollide_frame* frame, float tolerance, sbcollide_pairs* pairs) {
  const float *x = frame->x, *y = frame->y, *z = frame->z;
  (void)self;
  for (uint32_t a = 0; a < frame->vertex_count; ++a) {
    for (uint32_t b = a + 1; b < frame->vertex_count; ++b) {
      const float dx = x[a] - x[b], dy = y[a] - y[b], dz = z[a] - z[b];
      /* Squares are compared, so that no root is needed. */
      if (dx * dx + dy * dy + dz * dz < tolerance * tolerance) sbcollide_add(pairs, a, b);
    }
  }
}

/* Tells sbcollide about the method. Give it a key, a name and a sentence of your own.
   make() and destroy() are for memory that the method keeps from frame to frame. This one needs none. */
const sbcollide_method* sbcollide_guest(void) {
  static const sbcollide_method method = {
      SBCOLLIDE_METHOD_VERSION,
      "my-method", /* key, on the command line */
      "My method", /* name, in tables */
      "Tests each pair of vertices.",
      NULL, /* make */
      find,
      NULL, /* destroy */
  };
  return &method;
}
