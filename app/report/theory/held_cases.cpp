// Cases of chains and sheets that are held.

#include <cmath>

#include <glm/geometric.hpp>

#include "app/report/theory/closed_forms.h"
#include "app/report/theory/results.h"
#include "softbody/forces/air_drag.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"

namespace app::report {
namespace {

using closed_form::g;
using glm::dvec3;
using softbody::Material, softbody::Mesh, softbody::Scene, softbody::World;

/// Returns a scene with this mesh, at rest, held at these z (m). k, shear: N/m, along its edges and across its quads.
Scene held(Mesh mesh, double k, double shear, const std::vector<double>& z) {
  Material material = ball_material(k, 0.5);
  material.set(softbody::ShearSprings::keys, {shear, 0.5});
  material[softbody::BendSprings::stiffness] = material[softbody::ShapeMatching::frequency] = 0;
  material[softbody::AirDrag::drag] = 5;
  Scene scene = lone_scene(material);
  scene.bodies[0].mesh = source_of(std::move(mesh));
  for (const double at : z) scene.bodies[0].holds.push_back({.where = softbody::SolidBox{{0, 0, at}, {10, 10, 1e-3}}});
  return scene;
}

void chain(TheoryRun& run) {
  const int links = 10 << run.variant;
  constexpr double half = 1.5;  // the angle of half an arc, which is not yet a catenary
  const double radius = 0.5 / std::sin(half), length = links * 2 * radius * std::sin(half / links);
  Mesh mesh;
  for (softbody::Index i = 0; i <= softbody::Index(links); ++i) {
    const double angle = half * (2.0 * i / links - 1);
    mesh.vertices.emplace_back(0, radius * (std::cos(half) - std::cos(angle)), radius * std::sin(angle));
    if (i > 0) mesh.edges.push_back({i - 1, i});
  }
  Scene scene = held(std::move(mesh), 3e4 * links, 0, {-0.5, 0.5});
  scene.gravity = {0, -g, 0};
  World world = run.begin(scene);
  run.step(world, 240);
  run.comparisons = {{.theory = closed_form::catenary_sag(length, 1),
                      .measured = -double(world.positions().y[std::size_t(links / 2)]),
                      .bound = 0.01}};
}

void hanging_sheet(TheoryRun& run) {
  constexpr int columns = 4, rows = 8;
  Scene scene = held(softbody::quad_grid(columns, rows, 1, 2), 2'000, 0, {-1});
  scene.gravity = {0, 0, g};
  World world = run.begin(scene);
  run.step(world, 240);
  run.comparisons = {{.theory = g / (2 * 2'000.0 * (columns + 1) / rows),
                      .measured = double(world.positions().z.back()) - 1,
                      .bound = 0.01}};
}

void stretched_sheet(TheoryRun& run) {
  const int columns = 4 << run.variant, rows = 4 * columns;
  constexpr double width = 0.5, length = 2, strain = 2e-3, k = 2'000, shear = 1'000;
  Mesh mesh = softbody::quad_grid(columns, rows, width, length);
  for (const auto& [a, b] : mesh.edges) {  // at the border half a quad is beside a spring
    const dvec3 &p = mesh.vertices[a], &q = mesh.vertices[b];
    const bool border = (p.x == q.x && std::abs(p.x) == width / 2) || (p.z == q.z && std::abs(p.z) == length / 2);
    mesh.edge_shares.push_back(border ? 0.5 : 1);
  }
  World world = run.begin(held(std::move(mesh), k, shear, {-length / 2, length / 2}),
                          [](softbody::Particle& p) { p.position.z *= 1 + strain; });
  run.step(world, 240);
  const collide::Frame at = world.positions();
  const auto here = [&](std::size_t v) { return dvec3(at.x[v], at.y[v], at.z[v]); };
  double force = 0;  // through a cut beside the middle
  softbody::for_each_spring(world.model(0), [&](const softbody::Spring& s) {
    const double cut = length / rows / 2, now = glm::distance(here(s.i), here(s.j));
    if ((here(s.i).z < cut) != (here(s.j).z < cut))
      force += s.stiffness * (now - s.rest) * std::abs(here(s.j).z - here(s.i).z) / now;
  });
  const std::size_t row = std::size_t(columns) + 1, first = row * std::size_t(rows / 2);
  const double lengthened = (here(first + row).z - here(first - row).z) * rows / (2 * length) - 1;
  const double narrowed = 1 - (here(first + row - 1).x - here(first).x) / width, poisson = shear / (k + shear);
  const double theory = (k + shear - shear * poisson) * width * lengthened;
  run.comparisons = {{.what = "force, N", .theory = theory, .measured = force, .bound = 0.01},
                     {.what = "contraction", .theory = poisson, .measured = narrowed / lengthened, .bound = 0.01}};
}

}  // namespace

std::vector<TheoryCase> held_cases() {
  return {{"chain", "Hanging chain: sag, m", {"10 links", "20", "40"}, true, chain},
          {"hanging-sheet", "Hanging sheet: lengthening by its own weight, m", {""}, false, hanging_sheet},
          {"stretched-sheet", "Stretched sheet", {"4 x 16 quads", "8 x 32", "16 x 64"}, true, stretched_sheet}};
}

}  // namespace app::report
