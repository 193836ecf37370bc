#pragma once
// A mesh handed over in code that is finer than meshes are simulated.

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <sbcollide/softbody.h>

namespace api::test {

/// A ring around the y axis, 1.4 m wide and 0.4 m high, of 1,800 vertices. These are in the order of their first use,
/// so that an import from a file keeps it.
struct Ring {
  std::vector<float> xyz;
  std::vector<std::array<sbcollide::Index, 3>> triangles;

  Ring() {
    constexpr int around = 60, section = 30;
    std::map<std::array<int, 2>, sbcollide::Index> known;
    const auto vertex = [&](int i, int j) {
      const auto [found, is_new] =
          known.try_emplace({i % around, j % section}, static_cast<sbcollide::Index>(known.size()));
      constexpr double turn = 2 * std::numbers::pi;
      const double u = turn * i / around, v = turn * j / section, r = 0.5 + 0.2 * std::cos(v);
      if (is_new)
        for (const double c : {r * std::cos(u), 0.2 * std::sin(v), r * std::sin(u)})
          xyz.push_back(static_cast<float>(c));
      return found->second;
    };
    for (int i = 0; i < around; ++i)
      for (int j = 0; j < section; ++j) {
        triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)});
        triangles.push_back({vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)});
      }
  }
  int add_to(sbcollide::Scene& scene, int resolution = 0) const { return scene.add_mesh(xyz, triangles, resolution); }
};

}  // namespace api::test
