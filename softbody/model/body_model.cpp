#include "softbody/model/body_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "collide/surface/surface.h"
#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"
#include "softbody/model/spring_bound.h"

namespace softbody {
namespace {

constexpr double linear_below = 0.1;  // of V0: the gas law continues linearly, so that flat and inverted bodies recover

/// Returns springs of the material's stiffness. A net of equal springs has the stiffness of a sheet, however fine the
/// net is (Young's modulus times thickness = 2 k / sqrt(3)), so one stiffness in N/m fits every mesh. Where more than
/// six springs meet (the number in a regular net), they share the stiffness of six, so that the middle of a fan needs
/// no shorter steps than the rest.
template <class Force>
std::vector<Spring> make_springs(const BodyModel& p, const std::vector<Edge>& pairs) {
  std::vector<Spring> springs;
  if (p.material[Force::stiffness] <= 0) return springs;
  std::vector<int> meeting(p.mesh.vertices.size(), 0);
  for (const auto& [i, j] : pairs) ++meeting[i], ++meeting[j];
  for (const auto& [i, j] : pairs) {
    const double stiffness = p.material[Force::stiffness] * std::min(1.0, 6.0 / std::max(meeting[i], meeting[j]));
    const double damping =
        2 * p.material[Force::damping_ratio] * std::sqrt(stiffness * p.particle_mass / 2);  // reduced mass m / 2
    springs.push_back({i, j, glm::distance(p.mesh.vertices[i], p.mesh.vertices[j]), stiffness, damping});
  }
  return springs;
}

/// Sets the values for shape matching.
void set_shape(BodyModel& p, double frequency) {
  p.shape_rate = 2 * std::numbers::pi * frequency;
  p.goal.clear();
  if (p.shape_rate <= 0) return;
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& v : p.mesh.vertices) mean += v / double(p.mesh.vertices.size());
  for (const glm::dvec3& v : p.mesh.vertices) p.goal.push_back(v - mean);
}

/// Returns the material that acts on the particles of a mesh from a file. The given contact stiffness is for the
/// particles of the paper's sphere. If a body has more particles, more of them share a contact, so they share the
/// stiffness, too. Springs of very fine meshes become softer, so that a frame takes no more substeps than with the
/// finest mesh that has full springs.
Material for_mesh(Material m, const MeshSource& source) {
  constexpr double stated_for = 162, finest = 2000;  // vertices
  if (source.kind != "file") return m;
  const auto count = static_cast<double>(source.vertex_count());
  m[contact::stiffness] *= std::min(1.0, stated_for / count);
  for (const Key* key : {&StructuralSprings::stiffness, &BendSprings::stiffness, &ShearSprings::stiffness})
    m[*key] *= std::min(1.0, finest / count);
  return m;
}

void list_faces(BodyModel& p) {
  std::vector<std::vector<Index>> at(p.mesh.vertices.size());
  for (Index f = 0; f < p.mesh.triangles.size(); ++f)
    for (const Index corner : p.mesh.triangles[f]) at[corner].push_back(f);
  for (const auto& faces : at) {
    p.face.insert(p.face.end(), faces.begin(), faces.end());
    p.first_face.push_back(static_cast<Index>(p.face.size()));
  }
}

/// Sets everything that depends on the material, except the starting shape.
void give_material(BodyModel& p, const MeshSource& source, const Material& material) {
  p.material = for_mesh(material, source);
  p.particle_mass = material[Material::mass] / double(p.mesh.vertices.size());
  p.structural = make_springs<StructuralSprings>(p, p.mesh.edges);
  p.bend = make_springs<BendSprings>(p, p.mesh.bend_pairs);
  p.shear = make_springs<ShearSprings>(p, p.mesh.shear_pairs);
  const std::array lists{&std::as_const(p.structural), &std::as_const(p.bend), &std::as_const(p.shear)};
  p.spring_stiffness_bound = spring_bound(p.mesh.vertices.size(), lists, &Spring::stiffness) / 2;
  p.spring_damping_bound = spring_bound(p.mesh.vertices.size(), lists, &Spring::damping) / 2;
  const double by_kind = source.kind == "file" ? mesh_file_shape_frequency : 0;
  set_shape(p, material.given(ShapeMatching::frequency) ? material[ShapeMatching::frequency] : by_kind);
  if (!p.mesh.closed) return;
  p.gas.ambient = material[GasPressure::outside];
  p.gas.amount = material[GasPressure::inside] * p.gas.rest_volume;
  p.has_gas = material[GasPressure::inside] > 0 || material[GasPressure::outside] > 0;
}

}  // namespace

double Gas::pressure(double v) const {
  const double bend = linear_below * rest_volume;
  if (v >= bend) return amount / v;
  return amount / bend * (2 - v / bend);
}

double Gas::ambient_pressure(double v) const {
  return ambient * std::clamp(v / (linear_below * rest_volume), -1.0, 1.0);
}

double Gas::slope(double v) const {
  const double bend = linear_below * rest_volume, held = std::max(v, bend);
  return -amount / (held * held) - (std::abs(v) < bend ? ambient / bend : 0);
}

double Gas::ambient_energy(double v) const {
  const double bend = linear_below * rest_volume;
  const double pushed_away = std::abs(v) < bend ? (v * v + bend * bend) / (2 * bend) : std::abs(v);
  return ambient * (pushed_away - rest_volume);
}

double Gas::energy(double v) const {
  const double bend = linear_below * rest_volume;
  if (v >= bend) return ambient_energy(v) - amount * std::log(v / rest_volume);
  const double beyond = bend - v;  // the integral of the linear law from v to the bend
  return ambient_energy(v) - amount * std::log(linear_below) + amount / bend * (beyond + beyond * beyond / (2 * bend));
}

double stable_step(double k_m, double c_m) {
  // Twice the sum of a row bounds a spring matrix: each spring stands on its diagonal and beside it (Gershgorin).
  const double omega2 = 2 * k_m, gamma = 2 * c_m;
  if (omega2 <= 0) return gamma > 0 ? 0.8 * 2 / gamma : 1e9;
  const double omega = std::sqrt(omega2), z = gamma / (2 * omega);
  return 0.8 * (2 / omega) / (std::sqrt(1 + z * z) + z);  // sqrt(1 + z^2) - z, but exact for large z too
}

double stiffness_per_mass(const BodyModel& p, const SurfaceShape& surface) {
  // stable_step() doubles what springs do, for each also stands beside the diagonal; the shape's w^2 is no such sum.
  const double springs = p.spring_stiffness_bound / p.particle_mass + p.shape_rate * p.shape_rate / 2;
  if (!p.has_gas) return springs;
  // Gas: F_i = P A_i with the gauge pressure P, A_i = dV/dx_i. Its matrix is -dP/dV A A^T, of norm s = -dP/dV sum
  // |A_i|^2, plus P d2V/dx2. Breathing, which the first is about, hardly stretches springs: L being their Laplacian, l
  // its bound and a = A / |A|, q = a^T L a is far below l. An eigenvalue x > l of L + s a a^T has
  // 1 = s a^T (x - L)^-1 a <= s ((1 - q/l) / x + (q/l) / (x - l)), for 1 / (x - y) is convex in y, and so is at most
  // the larger root of x^2 - (l + s) x + s (l - q). In the second part, particles i and j of an edge are joined by a
  // sixth of the line between the two corners opposite, which is at most the medians from there to the edge together:
  // a row is at most two medians a face at i.
  const double slope = -p.gas.slope(surface.volume);
  const double gauge = std::abs(p.gas.gauge(surface.volume));
  const double l = 2 * p.spring_stiffness_bound, s = slope * surface.area2;
  const double q = surface.area2 > 0 ? std::min(l, surface.stretch / surface.area2) : 0;
  const double both = (l + s) / 2 + std::sqrt((l - s) * (l - s) / 4 + s * q);
  const double gas = both - l + gauge * p.largest_degree * surface.two_medians / 6;
  return springs + gas / (2 * p.particle_mass);  // nor is this
}

SurfaceShape measure_surface(const BodyModel& p, const std::vector<glm::dvec3>& vertices) {
  if (!p.has_gas) return {};
  SurfaceShape s{.volume = volume(vertices, p.mesh.triangles)};
  std::vector<glm::dvec3> area(vertices.size(), glm::dvec3(0));
  for (const auto& [i, j, k] : p.mesh.triangles) {
    const glm::dvec3 a = vertices[i], b = vertices[j], c = vertices[k], third = glm::cross(b - a, c - a) / 6.0;
    for (const Index corner : {i, j, k}) area[corner] += third;
    const double from_a = glm::distance(a, (b + c) / 2.0), from_b = glm::distance(b, (c + a) / 2.0),
                 from_c = glm::distance(c, (a + b) / 2.0);
    s.two_medians = std::max({s.two_medians, from_a + from_b, from_b + from_c, from_c + from_a});
  }
  for (const glm::dvec3& a : area) s.area2 += glm::dot(a, a);
  for (const auto* list : {&p.structural, &p.bend, &p.shear})
    for (const Spring& spring : *list) {
      const glm::dvec3 d = area[spring.i] - area[spring.j];
      s.stretch += spring.stiffness * glm::dot(d, d);
    }
  return s;
}

std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& source, const Material& material) {
  auto p = std::make_shared<BodyModel>();
  p->mesh = source.make();
  p->radius = bounding_radius(p->mesh);
  list_faces(*p);
  for (Index i = 0; i < p->mesh.vertices.size(); ++i)
    p->largest_degree = std::max(p->largest_degree, double(p->faces_of(i).size()));
  if (p->mesh.closed) p->gas.rest_volume = volume(p->mesh.vertices, p->mesh.triangles);
  give_material(*p, source, material);

  p->start = p->mesh.vertices;
  if (p->mesh.closed) p->start_volume = volume(p->start, p->mesh.triangles);
  const std::vector<glm::vec3> rest(p->mesh.vertices.begin(), p->mesh.vertices.end());
  p->surface = std::make_shared<collide::surface::Surface>(static_cast<Index>(rest.size()), p->mesh.triangles);
  for (const auto& [i, j] : p->surface->edges()) p->mean_edge += glm::distance(rest[i], rest[j]);
  p->mean_edge /= double(std::max<std::size_t>(1, p->surface->edges().size()));
  p->shape = std::make_shared<collide::Shape>(static_cast<Index>(p->mesh.vertices.size()), p->mesh.edges, rest);
  return p;
}

std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material) {
  auto p = std::make_shared<BodyModel>(model);
  give_material(*p, source, material);
  return p;
}

}  // namespace softbody
