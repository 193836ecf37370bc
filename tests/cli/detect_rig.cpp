#include "tests/cli/detect_rig.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>

namespace cli::test {
namespace {

float squared_distance(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const float dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
  return dx * dx + dy * dy + dz * dz;
}

std::set<std::array<unsigned, 2>> edges(const Body& body) {
  std::set<std::array<unsigned, 2>> pairs;
  for (const auto& face : body.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const unsigned a = face[i], b = face[(i + 1) % face.size()];
      pairs.insert({std::min(a, b), std::max(a, b)});
    }
  }
  return pairs;
}

Body crumpled_grid(unsigned columns, unsigned rows, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-0.2f, 0.2f), noise(-0.05f, 0.05f);
  const float x = place(random), y = place(random), z = place(random);
  Body body;
  for (unsigned r = 0; r < rows; ++r) {
    for (unsigned c = 0; c < columns; ++c) {
      const float u = 0.06f * static_cast<float>(c), v = 0.06f * static_cast<float>(r);
      body.vertices.push_back(
          {x + u + noise(random), y + 0.1f * std::sin(20 * u) + noise(random), z + v + noise(random)});
      if (c > 0 && r > 0) {
        const unsigned corner = r * columns + c;
        body.faces.push_back({corner - columns - 1, corner - columns, corner, corner - 1});
      }
    }
  }
  return body;
}

}  // namespace

std::string State::obj() const {
  std::string text = "# a test\nmtllib none.mtl\n";
  std::size_t base = 1;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (b > 0) text += fmt::format("o body {}\n", b);
    for (const auto& [x, y, z] : bodies[b].vertices) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x, y, z);
    for (const auto& face : bodies[b].faces) {
      text += 'f';
      for (const unsigned corner : face) text += fmt::format(" {}", base + corner);
      text += '\n';
    }
    base += bodies[b].vertices.size();
  }
  return text;
}

std::vector<ContactRow> oracle(unsigned frame, const State& state, const Rules& rules) {
  struct Vertex {
    unsigned body, local;
    std::array<float, 3> at;
  };
  std::vector<Vertex> all;
  std::vector<std::set<std::array<unsigned, 2>>> joined;
  for (unsigned b = 0; b < state.bodies.size(); ++b) {
    const Body& body = state.bodies[b];
    joined.push_back(edges(rules.edges ? rules.edges->bodies[b] : body));
    for (unsigned v = 0; v < body.vertices.size(); ++v) all.push_back({b, v, body.vertices[v]});
  }
  const float limit = rules.tolerance * rules.tolerance;
  std::vector<ContactRow> rows;
  for (unsigned i = 0; i < all.size(); ++i) {
    for (unsigned j = i + 1; j < all.size(); ++j) {
      const Vertex &a = all[i], &b = all[j];
      const float square = squared_distance(a.at, b.at);
      if (!(square < limit)) continue;
      if (a.body == b.body) {
        if (!rules.self || joined[a.body].contains({a.local, b.local})) continue;
        if (rules.rest) {
          const auto& rest = rules.rest->bodies[a.body].vertices;
          if (squared_distance(rest[a.local], rest[b.local]) < limit) continue;
        }
      }
      rows.push_back({frame, i, j, a.body, b.body, std::sqrt(square)});
    }
  }
  return rows;
}

State random_state(unsigned seed) {
  std::mt19937 random(seed);
  State state;
  for (const unsigned size : {9u, 4u, 14u, 2u, 6u})
    state.bodies.push_back(crumpled_grid(size, size + seed % 3, random));
  state.bodies.insert(state.bodies.begin() + 2, Body{});
  state.bodies.push_back({{{0.1f, 0.1f, 0.1f}}, {}});
  return state;
}

State moved(const State& state, float max, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> step(-max, max);
  State result = state;
  for (Body& body : result.bodies) {
    body.faces.clear();
    for (auto& vertex : body.vertices) {
      for (float& coordinate : vertex) coordinate += step(random);
    }
  }
  return result;
}

std::vector<ContactRow> read_contacts(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  EXPECT_TRUE(text.ends_with('\n'));
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "frame,vertex_a,vertex_b,body_a,body_b,distance");
  std::vector<ContactRow> rows;
  while (std::getline(in, line)) {
    ContactRow r{};
    std::sscanf(line.c_str(), "%u,%u,%u,%u,%u,%g", &r.frame, &r.vertex_a, &r.vertex_b, &r.body_a, &r.body_b,
                &r.distance);
    EXPECT_EQ(line,
              fmt::format("{},{},{},{},{},{:.9g}", r.frame, r.vertex_a, r.vertex_b, r.body_a, r.body_b, r.distance));
    rows.push_back(r);
  }
  return rows;
}

}  // namespace cli::test
