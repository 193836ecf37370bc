#include "states.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace collide::test {

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

State random_cloud() {
  State state;
  std::mt19937 random(1);
  for (int body = 0; body < 9; ++body) {
    const float lo = uniform(random, -1.5f, 0.5f);
    state.add(random_points(random, 40, lo, lo + 1));
  }
  state.tolerance = 0.12f;
  return state;
}

/// Spheres on a grid, 10 to 20 % of the radius inside each other, as after they have settled.
State settled(int subdivisions, int side, bool with_rest, const glm::vec3& origin, float radius) {
  State state;
  std::mt19937 random(2);
  const Ball ball = icosphere(subdivisions, radius);
  const auto shape = std::make_shared<const Shape>(static_cast<Index>(ball.vertices.size()), ball.edges,
                                                   with_rest ? ball.vertices : std::vector<glm::vec3>{});
  for (int i = 0; i < side * side * side; ++i) {
    const auto at = [&](int k) { return radius * (1.85f * static_cast<float>(k) + uniform(random, -0.03f, 0.03f)); };
    const float ax = at(i % side), ay = at(i / side % side), az = at(i / side / side);
    state.add(shape, moved(ball.vertices, origin + glm::vec3(ax, ay, az)));
  }
  state.tolerance = 0.2f * radius;
  return state;
}

/// A body that is folded on itself, so that it has self contacts that its shape does not leave out.
State crumpled() {
  State state;
  std::mt19937 random(3);
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(static_cast<Index>(ball.vertices.size()), ball.edges, ball.vertices);
  for (int body = 0; body < 3; ++body) {
    std::vector<glm::vec3> vertices = moved(ball.vertices, glm::vec3(0.4f * static_cast<float>(body), 0, 0));
    for (glm::vec3& v : vertices) v.y = 0.1f * v.y + uniform(random, -0.02f, 0.02f);
    state.add(shape, vertices);
  }
  return state;
}

/// Whole numbers: vertices, midpoints and cell borders fall on each other, and distances equal the tolerance exactly.
State lattice(float tolerance) {
  State state;
  std::vector<glm::vec3> cube;
  for (int i = 0; i < 125; ++i) {
    cube.push_back(glm::vec3(static_cast<float>(i % 5), static_cast<float>(i / 5 % 5), static_cast<float>(i / 25)));
  }
  for (const float offset : {-4.0f, 0.0f, 3.0f, 5.0f}) state.add(moved(cube, glm::vec3(offset, 0, -offset)));
  state.tolerance = tolerance;
  return state;
}

State coincident() {
  State state;
  for (int body = 0; body < 3; ++body) state.add(std::vector<glm::vec3>(30, glm::vec3(0.25f, -1, 7)));
  return state;
}

State flat() {
  State state;
  std::mt19937 random(4);
  for (int body = 0; body < 6; ++body) {
    std::vector<glm::vec3> points = random_points(random, 50, -1, 1);
    for (glm::vec3& p : points) p[body % 3] = 0.5f;  // a plane,
    if (body >= 3)
      for (glm::vec3& p : points) p[(body + 1) % 3] = 0;  // a line
    state.add(points);
  }
  return state;
}

State small_bodies() {
  State state;
  std::mt19937 random(5);
  state.add({});
  for (int body = 0; body < 60; ++body) {
    state.add(random_points(random, 1, -0.5f, 0.5f));
    if (body % 7 == 0) state.add({});
  }
  state.add({});
  state.tolerance = 0.3f;
  return state;
}

State empty_bodies() {
  State state;
  state.add({});
  state.add({});
  return state;
}

State not_finite() {
  State state = settled(1, 2, true, glm::vec3(0), 0.5f);
  state.x[42 * 1 + 5] = nan;
  state.y[42 * 4 + 41] = infinity;
  state.z[42 * 6 + 0] = -infinity;
  return state;
}

/// One body of normal size far from all others, and one in both directions at the end of the range.
State scattered() {
  State state;
  std::mt19937 random(6);
  for (const float centre : {0.0f, 0.3f, 1e6f, -1e8f}) {
    state.add(random_points(random, 40, centre - 0.5f, centre + 0.5f));
  }
  state.add(random_points(random, 40, -1e30f, 1e30f));
  state.add({glm::vec3(largest), glm::vec3(-largest), glm::vec3(0), glm::vec3(largest), glm::vec3(2e38f, 3e38f, 0)});
  state.add({glm::vec3(2e38f), glm::vec3(3e38f), glm::vec3(largest)});
  return state;
}

/// scale: m, of the coordinates. Their squares may underflow, the tolerance's does not.
State tiny(float scale) {
  State state;
  std::mt19937 random(7);
  for (int body = 0; body < 6; ++body) state.add(random_points(random, 30, -4 * scale, 4 * scale));
  state.tolerance = min_tolerance;
  return state;
}

State huge_tolerance(float tolerance) {
  State state = scattered();
  state.tolerance = tolerance;
  return state;
}

/// Bodies of unlike sides and numbers of vertices deep inside each other: their overlap is cut many times.
State large() {
  State state;
  const auto ellipsoid = [&](int subdivisions, const glm::vec3& sides, const glm::vec3& at) {
    Ball ball = icosphere(subdivisions, 0.5f);
    for (glm::vec3& v : ball.vertices) v *= sides;
    const auto count = static_cast<Index>(ball.vertices.size());
    state.add(std::make_shared<const Shape>(count, ball.edges, ball.vertices), moved(ball.vertices, at));
  };
  ellipsoid(3, glm::vec3(1, 0.7f, 0.5f), glm::vec3(0));
  ellipsoid(4, glm::vec3(0.6f, 1.1f, 0.8f), glm::vec3(0.35f, 0.1f, -0.15f));
  state.tolerance = 0.05f;
  return state;
}

/// Pairs of unlike balls that only just touch, each along the line of its centres, where floats are coarse.
State touching_far_away() {
  State state;
  std::mt19937 random(9);
  const Ball small = icosphere(0, 0.5f), large = icosphere(1, 0.8f);
  state.tolerance = 0.01f;
  for (std::size_t k = 0; k < small.vertices.size(); ++k) {
    const glm::vec3 at = random_points(random, 1, -1e5f, 1e5f)[0], way = small.vertices[k] / 0.5f;
    state.add(moved(small.vertices, at));
    state.add(moved(large.vertices, at + 1.305f * way));
  }
  return state;
}

/// A large sheet with fine vertices under small balls: boxes of very different sizes.
State uneven() {
  State state = settled(1, 2, true, glm::vec3(-0.5f, 0.4f, -0.5f), 0.3f);
  std::mt19937 random(8);
  std::vector<glm::vec3> sheet = random_points(random, 300, -20, 20);
  for (glm::vec3& p : sheet) p = glm::vec3(p.x * (std::abs(p.z) < 10 ? 0.05f : 1), 0.1f, p.z * 0.05f);
  state.add(sheet);
  state.tolerance = 0.2f;
  return state;
}

}  // namespace

void State::add(std::shared_ptr<const Shape> shape, const std::vector<glm::vec3>& positions) {
  bodies.add(std::move(shape));
  for (const glm::vec3& p : positions) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
}

void State::add(const std::vector<glm::vec3>& positions) {
  add(std::make_shared<const Shape>(static_cast<Index>(positions.size()), std::span<const std::array<Index, 2>>{}),
      positions);
}

Ball icosphere(int subdivisions, float radius) {
  const float g = 1.618034f;
  Ball ball;
  ball.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<Index, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  const auto on_sphere = [&](const glm::vec3& v) {
    return v * (radius / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
  };
  for (glm::vec3& v : ball.vertices) v = on_sphere(v);
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto halve = [&](Index a, Index b) {
      const auto [found, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(ball.vertices.size()));
      if (fresh) ball.vertices.push_back(on_sphere(ball.vertices[a] + ball.vertices[b]));
      return found->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const Index ab = halve(a, b), bc = halve(b, c), ca = halve(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = finer;
  }
  for (const auto& [a, b, c] : faces) ball.edges.insert(ball.edges.end(), {{a, b}, {b, c}, {c, a}});
  ball.faces = std::move(faces);
  return ball;
}

std::vector<glm::vec3> moved(std::vector<glm::vec3> vertices, const glm::vec3& by) {
  for (glm::vec3& v : vertices) v += by;
  return vertices;
}

float uniform(std::mt19937& random, float lo, float hi) {  // the same with every standard library
  const float t = static_cast<float>(random() >> 8) * 0x1p-24f;
  return lo * (1 - t) + hi * t;
}

long double distance(const glm::vec3& a, const glm::vec3& b) {
  const auto d = glm::vec<3, long double>(a) - glm::vec<3, long double>(b);
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

std::vector<glm::vec3> random_points(std::mt19937& random, std::size_t count, float lo, float hi) {
  std::vector<glm::vec3> points(count);
  for (glm::vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = uniform(random, lo, hi);
  }
  return points;
}

const std::vector<NamedState>& named_states() {
  static const std::vector<NamedState> states{
      {"random_cloud", random_cloud},
      {"settled", [] { return settled(2, 2, true, glm::vec3(0), 0.5f); }},
      {"settled_negative", [] { return settled(1, 2, false, glm::vec3(-7.3f), 0.5f); }},
      {"settled_at_1e6", [] { return settled(1, 2, true, glm::vec3(1e6f, -1e6f, 0), 0.5f); }},
      {"settled_at_4e19", [] { return settled(1, 2, true, glm::vec3(-4e19f, 4e19f, 4e19f), 4e18f); }},
      {"crumpled", crumpled},
      {"lattice", [] { return lattice(1); }},  // neighbours are 1 apart and no contact
      {"lattice_just_reached", [] { return lattice(std::nextafter(1.0f, 2.0f)); }},
      {"coincident", coincident},
      {"flat", flat},
      {"small_bodies", small_bodies},
      {"no_bodies", [] { return State(); }},
      {"empty_bodies", empty_bodies},
      {"not_finite", not_finite},
      {"scattered", scattered},
      {"tiny_normal", [] { return tiny(1e-18f); }},
      {"tiny_squares_denormal", [] { return tiny(2e-22f); }},
      {"tiny_squares_vanish", [] { return tiny(1e-40f); }},
      {"huge_tolerance", [] { return huge_tolerance(1e10f); }},
      {"max_tolerance", [] { return huge_tolerance(max_tolerance); }},
      {"uneven", uneven},
      {"large", large},
      {"touching_far_away", touching_far_away},
  };
  return states;
}

bool finite(const State& state, Index body) {
  bool all = true;
  for (Index v = state.bodies.first[body]; v < state.bodies.first[body + 1]; ++v) {
    all = all && std::isfinite(state.x[v]) && std::isfinite(state.y[v]) && std::isfinite(state.z[v]);
  }
  return all;
}

std::vector<Contact> oracle(const State& state, const Settings& settings) {
  const float tolerance2 = settings.tolerance * settings.tolerance;
  const Bodies& bodies = state.bodies;
  std::vector<Index> body_of;
  std::vector<bool> finite_bodies;
  for (Index body = 0; body < bodies.count(); ++body) {
    body_of.insert(body_of.end(), bodies.size(body), body);
    finite_bodies.push_back(finite(state, body));
  }
  std::vector<Contact> contacts;
  for (Index i = 0; i < state.x.size(); ++i) {
    for (Index j = i + 1; j < state.x.size(); ++j) {
      const float dx = state.x[i] - state.x[j], dy = state.y[i] - state.y[j], dz = state.z[i] - state.z[j];
      if (!(dx * dx + dy * dy + dz * dz < tolerance2)) continue;
      const Index a = body_of[i], b = body_of[j];
      if (!finite_bodies[a] || !finite_bodies[b]) continue;
      if (a == b && !settings.self_collision) continue;
      if (a == b && bodies.shape[a]->excludes(i - bodies.first[a], j - bodies.first[a], tolerance2)) continue;
      contacts.push_back({i, j});
    }
  }
  return contacts;
}

std::vector<Contact> inside_bodies(const State& state, const std::vector<Contact>& contacts) {
  std::vector<Contact> inside;
  for (const Contact& contact : contacts)
    if (state.bodies.body_of(contact.a) == state.bodies.body_of(contact.b)) inside.push_back(contact);
  return inside;
}

Result detect(std::string_view method, const State& state, const Settings& settings, int threads) {
  Workers workers(threads, 0);
  Result result;
  find_method(method)->make()->detect(state.frame(), settings, workers, result);
  return result;
}

}  // namespace collide::test
