#include <array>

#include "tests/bench/step/stepper.h"

namespace bench {
namespace {

constexpr std::array<Entrant, 7> table{{
    {"vertex-vertex", "vertex-vertex contact", 1, make_vertex_world},
    {"surface", "surface contact", 1, make_surface_world},
    {"surface-240", "surface contact, 240 Hz", 4, make_surface_world},
    {"bullet-vertex-face", "Bullet, vertex-face, no self contact", 1, make_bullet_vertex_face},
    {"bullet-vertex-face-240", "the same, 240 Hz", 4, make_bullet_vertex_face},
    {"bullet-clusters", "Bullet, clusters and self contact", 1, make_bullet_clusters},
    {"bullet-clusters-240", "the same, 240 Hz", 4, make_bullet_clusters},
}};

}  // namespace

std::span<const Entrant> entrants() { return table; }

}  // namespace bench
