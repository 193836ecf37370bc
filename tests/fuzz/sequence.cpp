#include "sequence.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <tuple>

namespace fuzz {

namespace {

using collide::Index;
using collide::test::uniform;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

float hostile(Bytes& bytes) {
  return bytes.one_of({std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, largest, -largest, 1e30f, -1e19f,
                       1e6f, 0.0f, -0.0f, std::numeric_limits<float>::denorm_min(), 1e-40f, 1e-20f,
                       std::bit_cast<float>(bytes.word())});
}

glm::vec3 near_origin(Bytes& bytes) {
  const float x = bytes.fraction(), y = bytes.fraction(), z = bytes.fraction();
  return glm::vec3(x, y, z) * 1.5f;
}

glm::vec3 noise(std::mt19937& random, float size) { return collide::test::random_points(random, 1, -size, size)[0]; }

/// A sphere with the edges of its mesh, and with or without its rest positions. Each is made once: that takes longer
/// than most inputs.
const Bodies::One& sphere(int subdivisions, float radius, bool with_rest) {
  static std::map<std::tuple<int, float, bool>, Bodies::One> made;
  const auto [found, fresh] = made.try_emplace({subdivisions, radius, with_rest});
  if (fresh) {
    collide::test::Ball mesh = collide::test::icosphere(subdivisions, radius);
    const auto count = static_cast<Index>(mesh.vertices.size());
    const std::vector<glm::vec3> rest = with_rest ? mesh.vertices : std::vector<glm::vec3>{};
    found->second = {std::make_shared<const collide::Shape>(count, mesh.edges, rest), std::move(mesh.vertices)};
  }
  return found->second;
}

Bodies::One ball(Bytes& bytes, const Sizes& sizes) {
  const int subdivisions = std::min(bytes.one_of({0, 1, 1, 1, 2}), sizes.subdivisions);
  const float radius = bytes.one_of({0.5f, 0.5f, 0.3f, 2.0f});
  const bool with_rest = bytes.below(4) != 0;
  const Bodies::One& one = sphere(subdivisions, radius, with_rest);
  return {one.shape, collide::test::moved(one.positions, near_origin(bytes))};
}

/// Points in a box of any size, all in one place for size 0, with a few edges between any of them.
Bodies::One cloud(Bytes& bytes, const Sizes& sizes) {
  const auto count = static_cast<Index>(bytes.below(sizes.points));
  const float size = bytes.one_of({0.0f, 0.1f, 0.5f, 0.5f, 1.0f, 1e-20f, 1e-40f, 1e6f, 1e19f, 1e30f});
  const glm::vec3 centre = near_origin(bytes);
  std::mt19937 random = bytes.random();
  std::vector<glm::vec3> points(count);
  for (glm::vec3& point : points) point = centre + noise(random, size);
  std::vector<std::array<Index, 2>> edges(count == 0 ? 0 : static_cast<std::size_t>(bytes.below(16)));
  for (auto& [a, b] : edges) {
    a = static_cast<Index>(random() % count);
    b = static_cast<Index>(random() % count);
  }
  const bool with_rest = bytes.below(2) != 0;
  return {std::make_shared<const collide::Shape>(count, edges, with_rest ? points : std::vector<glm::vec3>{}), points};
}

/// Points with whole coordinates, so that distances, midpoints and cell borders fall on each other.
Bodies::One lattice(Bytes& bytes, const Sizes& sizes) {
  std::vector<glm::vec3> points;
  const int sides = 1 + bytes.below(sizes.sides);
  const glm::vec3 corner(0.5f * static_cast<float>(bytes.below(5)), 0, 0.5f * static_cast<float>(bytes.below(5)));
  for (int i = 0; i < sides * sides * sides; ++i) {
    points.push_back(corner + glm::vec3(i % sides, i / sides % sides, i / sides / sides) / 2.0f);
  }
  return {std::make_shared<const collide::Shape>(static_cast<Index>(points.size()),
                                                 std::span<const std::array<Index, 2>>{}),
          points};
}

Bodies::One read_body(Bytes& bytes, const Sizes& sizes) {
  switch (bytes.below(4)) {
    case 0:
      return cloud(bytes, sizes);
    case 1:
      return lattice(bytes, sizes);
    default:
      return ball(bytes, sizes);
  }
}

/// Moves one body as a whole, bends it, or spoils one of its vertices.
void change_body(Bodies::One& body, Bytes& bytes) {
  std::vector<glm::vec3>& points = body.positions;
  if (points.empty()) return;
  glm::vec3& picked = points[bytes.word() % points.size()];
  switch (bytes.below(8)) {
    case 0:
      points = collide::test::moved(points, near_origin(bytes));
      break;
    case 1:
      points = collide::test::moved(points, 0.02f * near_origin(bytes));
      break;
    case 2:
      points = collide::test::moved(points, glm::vec3(hostile(bytes), 0, 0));
      break;
    case 3:
      picked += near_origin(bytes);
      break;
    case 4:
      picked[bytes.below(3)] = hostile(bytes);
      break;
    case 5:
      picked = points[bytes.word() % points.size()];
      break;
    case 6: {
      std::mt19937 random = bytes.random();
      for (glm::vec3& point : points) point += noise(random, 0.05f);
      break;
    }
    default: {
      const int axis = bytes.below(3);
      const float by = bytes.fraction(), middle = points.front()[axis];
      for (glm::vec3& point : points) point[axis] = middle + by * (point[axis] - middle);  // flattened or turned over
    }
  }
}

}  // namespace

collide::test::State Bodies::state(float tolerance) const {
  collide::test::State state;
  for (const One& one : all) state.add(one.shape, one.positions);
  state.tolerance = tolerance;
  return state;
}

collide::Settings read_settings(Bytes& bytes) {
  collide::Settings settings;
  const bool usual = bytes.below(8) != 0;
  settings.tolerance = usual
                           ? bytes.one_of({0.1f, 0.1f, 0.05f, 0.2f, 0.02f})
                           : bytes.one_of({0.5f, 1.0f, collide::min_tolerance, 1e-12f, 1e10f, collide::max_tolerance});
  settings.self_collision = bytes.below(4) != 0;
  settings.levels = bytes.below(collide::max_levels + 1);
  settings.buckets = bytes.one_of({1001u, 101u, 1u, 2u, 65536u, 1 + bytes.word() % 5000});
  settings.cell_size.emplace();
  for (int axis = 0; axis < 3; ++axis) {
    (*settings.cell_size)[axis] = bytes.one_of({0.6f, 0.25f, 1.0f, 0.1f, 1e-6f, 1e-38f, 1e6f, 1e30f});
  }
  if (bytes.below(4) == 0) settings.primes = {bytes.word() | 1, bytes.word() | 1, bytes.word() | 1};
  return settings;
}

Bodies read_bodies(Bytes& bytes, const Sizes& sizes) {
  Bodies bodies{sizes, {}};
  const int count = bytes.below(sizes.bodies);
  for (int body = 0; body < count; ++body) bodies.all.push_back(read_body(bytes, sizes));
  return bodies;
}

void change(Bodies& bodies, Bytes& bytes) {
  std::vector<Bodies::One>& all = bodies.all;
  const int changes = bytes.below(4);  // often none: bodies at rest
  for (int k = 0; k < changes; ++k) {
    const int what = bytes.below(8);
    if (what == 0 && all.size() < static_cast<std::size_t>(bodies.sizes.bodies)) {
      all.push_back(read_body(bytes, bodies.sizes));
    } else if (!all.empty()) {
      const auto picked = static_cast<std::ptrdiff_t>(bytes.word() % all.size());
      if (what == 1) {
        all.erase(all.begin() + picked);
      } else if (what == 2) {
        std::swap(all.front(), all[static_cast<std::size_t>(picked)]);
      } else {
        change_body(all[static_cast<std::size_t>(picked)], bytes);
      }
    }
  }
}

}  // namespace fuzz
