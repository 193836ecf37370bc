// A guest that does wrong in the way that the tolerance (m) says; below 1 m it is the double loop.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include <sbcollide/method.h>

#include "tests/guest/wrongs.h"

namespace {

void loop(const sbcollide_frame* frame, float tolerance, sbcollide_pairs* pairs) {
  for (uint32_t a = 0; a < frame->vertex_count; ++a)
    for (uint32_t b = 0; b < frame->vertex_count; ++b) {  // each pair twice, and each vertex with itself
      const float x = frame->x[a] - frame->x[b], y = frame->y[a] - frame->y[b], z = frame->z[a] - frame->z[b];
      if (x * x + y * y + z * z < tolerance * tolerance) sbcollide_add(pairs, a, b);
    }
}

void find(void* self, const sbcollide_frame* frame, float tolerance, sbcollide_pairs* pairs) {
  using tests::Wrong;
  auto& searches = *static_cast<uint32_t*>(self);
  switch (static_cast<Wrong>(static_cast<int>(tolerance))) {
    case Wrong::none:
      return loop(frame, tolerance, pairs);
    case Wrong::segfault:
      *static_cast<volatile int*>(nullptr) = 1;
      return;
    case Wrong::abort:
      std::abort();
    case Wrong::exit:
      std::exit(0);
    case Wrong::endless:
      for (volatile bool on = true; on;) continue;
      return;
    case Wrong::fork:
      // Each process that it can start would stay.
      while (fork() > 0) continue;
      throw std::runtime_error("no process can be started");
    case Wrong::too_many_pairs:
      pairs->next = pairs->end;  // after a while
      return sbcollide_add(pairs, 0, 1);
    case Wrong::out_of_range:
      return sbcollide_add(pairs, 0, frame->vertex_count);
    case Wrong::writes_frame:
      const_cast<float*>(frame->x)[0] = 1;
      return;
    case Wrong::much_memory:
      std::vector<char>(std::size_t{10} << 30);
      return;
    case Wrong::reads_input:
      if (std::getchar() != EOF) std::abort();
      std::puts("printed");
      std::fputs("printed\n", stderr);
      return loop(frame, 0.5f, pairs);
    case Wrong::throws:
      throw std::runtime_error("no\nidea");
    case Wrong::counts:  // not wrong
      sbcollide_add(pairs, 0, 1 + searches++);
      sbcollide_add(pairs, 1, frame->edge_count);
      sbcollide_add(pairs, 2, frame->triangle_count);
      sbcollide_add(pairs, 3, frame->first_vertex[frame->body_count] - 1);
      for (uint32_t i = 0; i < frame->edge_count; ++i)
        sbcollide_add(pairs, frame->edges[2 * i], frame->edges[2 * i + 1]);
      return sbcollide_add(pairs, frame->triangles[0], frame->triangles[1]);
  }
}

const sbcollide_method method{SBCOLLIDE_METHOD_VERSION,
                              "hostile",
                              "Hostile",
                              "Does wrong.",
                              []() -> void* { return new uint32_t(0); },
                              find,
                              [](void* self) { delete static_cast<uint32_t*>(self); }};

}  // namespace

SBCOLLIDE_GUEST const sbcollide_method* sbcollide_guest() { return &method; }
