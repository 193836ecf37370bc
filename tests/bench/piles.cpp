#include "tests/bench/piles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "engine/resources.h"
#include "softbody/world/world.h"
#include "tests/solids.h"

namespace bench {
namespace {

/// A fixed seed and no distribution of the library's, so that every machine records the same states.
class Random {
 public:
  double between(double lo, double hi) { return lo + (hi - lo) * double(engine_()) * 0x1p-32; }
  glm::dvec3 in_ball() {
    glm::dvec3 v;
    do v = {between(-1, 1), between(-1, 1), between(-1, 1)};
    while (glm::dot(v, v) > 1);
    return v;
  }
  glm::dvec3 direction() {
    glm::dvec3 v = in_ball();
    while (glm::dot(v, v) < 1e-6) v = in_ball();
    return glm::normalize(v);
  }

 private:
  std::mt19937 engine_;
};

State::Positions copy(const collide::Frame& frame) {
  return {{frame.x.begin(), frame.x.end()}, {frame.y.begin(), frame.y.end()}, {frame.z.begin(), frame.z.end()}};
}

/// The last of `frames` frames of a scene of icospheres.
State settle(softbody::Scene scene, int frames, int threads) {
  State state;
  for (const softbody::BodySource& body : scene.bodies) state.radius.push_back(float(body.mesh.radius));
  softbody::World world(std::move(scene), {.threads = threads});
  while (world.frame() < frames) world.step();
  state.frames.push_back(copy(world.positions()));
  state.bodies = make_bodies(state.radius);
  return state;
}

/// Consecutive frames of a shipped scene whose bodies are all alike and there from the start, from frame `first` on.
State recorded(std::string_view scene_key, int first, int threads) {
  constexpr int frames = 40;
  softbody::Scene scene = softbody::find_scene(std::string(scene_key), engine::find_folder("assets") / "scenes");
  const auto radius = float(scene.bodies.front().mesh.radius);
  softbody::World world(std::move(scene), {.threads = threads});
  State state;
  state.radius.assign(world.positions().bodies->count(), radius);
  state.bodies = make_bodies(state.radius);
  while (world.frame() < first + frames) {
    world.step();
    if (world.frame() > first) state.frames.push_back(copy(world.positions()));
  }
  return state;
}

/// The centre of each body.
std::vector<glm::dvec3> centres(const State& state) {
  const State::Positions& p = state.frames.front();
  std::vector<glm::dvec3> all;
  for (collide::Index b = 0; b < state.bodies.count(); ++b) {
    glm::dvec3 sum{0.0};
    for (auto v = state.bodies.first[b]; v < state.bodies.first[b + 1]; ++v) sum += glm::dvec3(p.x[v], p.y[v], p.z[v]);
    all.push_back(sum / double(state.bodies.size(b)));
  }
  return all;
}

/// Frame k of a motion of a given mean size: each body drifts and turns steadily, and every vertex trembles.
State::Positions moved(const State& state, int k, double step) {
  Random random;
  const State::Positions& start = state.frames.front();
  const auto centre = centres(state);
  State::Positions p = start;
  for (collide::Index b = 0; b < state.bodies.count(); ++b) {
    const glm::dvec3 drift = 0.8 * step * k * random.direction(), axis = random.direction();
    const double angle = 0.4 * step * k / double(state.radius[b]), sine = std::sin(angle), cosine = std::cos(angle);
    for (auto v = state.bodies.first[b]; v < state.bodies.first[b + 1]; ++v) {
      const glm::dvec3 arm = glm::dvec3(start.x[v], start.y[v], start.z[v]) - centre[b];
      const glm::dvec3 turned = cosine * arm + sine * glm::cross(axis, arm) + (1 - cosine) * glm::dot(axis, arm) * axis;
      const double phase = random.between(0, 6.283185307179586) + 2.4 * k;  // 2.4: frames in a row differ
      const glm::dvec3 place = centre[b] + turned + drift + 0.1 * step * std::sin(phase) * random.direction();
      p.x[v] = float(place.x), p.y[v] = float(place.y), p.z[v] = float(place.z);
    }
  }
  return p;
}

/// Adds the frames after the first. A settled pile hardly moves by itself; this motion has the mean size `motion`.
State in_motion(State state) {
  State trial = state;
  trial.frames.push_back(moved(state, 1, motion));
  const double step = motion * motion / mean_displacement(trial);
  for (int k = 1; k < recorded_frames; ++k) state.frames.push_back(moved(state, k, step));
  return state;
}

/// A block of bodies on the ground, layer by layer, with the material of a shipped scene.
softbody::Scene block(int columns, int layers, int rows, std::span<const double> radii) {
  softbody::Scene scene = softbody::find_scene("drop-3000", engine::find_folder("assets") / "scenes");
  softbody::BodySource body = scene.bodies.front();
  scene.bodies.clear();
  tests::remove_solids<softbody::SolidSphere>(scene);
  scene.sleep.speed = 0.05;
  Random random;
  const double spacing = 2.2 * *std::max_element(radii.begin(), radii.end());
  for (int i = 0; i < columns * layers * rows; ++i) {
    const int column = i % columns, row = i / columns % rows, layer = i / columns / rows;
    body.mesh.radius = radii[std::size_t(random.between(0, double(radii.size())))];
    // Each layer stands over the gaps of the one below, so that the block settles into a packing, not into columns.
    const double shift = layer % 2 * 0.5;
    body.position = spacing * glm::dvec3(column + shift, layer + 0.6, row + shift) + 0.05 * random.in_ball();
    scene.bodies.push_back(body);
  }
  return scene;
}

/// Pulls the bodies' centres towards the origin, by a part of their distance.
State squeezed(State state, double part) {
  const auto centre = centres(state);
  State::Positions& p = state.frames.front();
  for (collide::Index b = 0; b < state.bodies.count(); ++b)
    for (auto v = state.bodies.first[b]; v < state.bodies.first[b + 1]; ++v) {
      p.x[v] -= float(part * centre[b].x);
      p.y[v] -= float(part * centre[b].y);
      p.z[v] -= float(part * centre[b].z);
    }
  return state;
}

/// Bodies lie in a pile and touch. The scenes' contact layer, 0.67 mean edges wide, has kept them that far apart, more
/// than the tolerances that are timed here: the squeeze closes the gap.
State pile(softbody::Scene scene, int threads) {
  constexpr int frames = 240;
  constexpr double gap = 0.05;
  return squeezed(settle(std::move(scene), frames, threads), gap);
}

constexpr std::array one_size{0.5};
constexpr std::array mixed_sizes{0.25, 0.5, 0.75, 1.0};

softbody::Scene block_47() {
  softbody::Scene scene = block(4, 3, 4, one_size);
  scene.bodies.pop_back();
  return scene;
}
State pile_500(int threads) { return pile(block(10, 5, 10, one_size), threads); }

constexpr std::array<Pile, 9> table{{
    {"pile-47", "47 bodies at rest", 47, [](int threads) { return in_motion(pile(block_47(), threads)); }},
    {"pile-500", "500 bodies at rest", 500, [](int threads) { return in_motion(pile_500(threads)); }},
    {"overlap-500", "the same, pulled together: neighbours overlap by 20 % of their diameter", 500,
     [](int threads) { return in_motion(squeezed(pile_500(threads), 0.2)); }},
    {"mixed-500", "500 bodies of radius 0.25 to 1 m at rest", 500,
     [](int threads) { return in_motion(pile(block(10, 5, 10, mixed_sizes), threads)); }},
    {"pile-3125", "3,125 bodies at rest", 3125,
     [](int threads) { return in_motion(pile(block(25, 5, 25, one_size), threads)); }},
    {"D-20", "frames 20 to 59 of scene D: bodies hit the solid sphere and one another", 47,
     [](int threads) { return recorded("D", 19, threads); }},
    {"D-150", "frames 150 to 189 of scene D: a heap that moves slowly", 47,
     [](int threads) { return recorded("D", 149, threads); }},
    {"D-400", "frames 400 to 439 of scene D: most bodies sleep", 47,
     [](int threads) { return recorded("D", 399, threads); }},
    {"container-160", "frames 160 to 199 of scene container: a crowd that settles", 47,
     [](int threads) { return recorded("container", 159, threads); }},
}};

}  // namespace

std::span<const Pile> piles() { return table; }

}  // namespace bench
