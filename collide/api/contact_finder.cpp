// The public interface: checks what it is given, and calls the detectors.

#include <algorithm>
#include <limits>

#include "collide/api/guarded.h"
#include "collide/api/sbcollide/collide.h"
#include "collide/methods.h"

namespace sbcollide {
namespace {

using Edges = std::vector<std::array<Index, 2>>;

Edges edges_of(const BodyMesh& mesh) {
  Edges edges(mesh.edges.begin(), mesh.edges.end());
  for (const auto& [a, b, c] : mesh.triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  return edges;
}

std::vector<glm::vec3> positions_of(std::span<const float> xyz) {
  std::vector<glm::vec3> positions;
  positions.reserve(xyz.size() / 3);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  return positions;
}

collide::Settings settings_of(const FinderSettings& s) {
  const auto [x, y, z] = s.cell_size;
  const bool automatic = x == 0 && y == 0 && z == 0;
  collide::Settings settings{
      .tolerance = s.tolerance, .self_collision = s.self_collision, .levels = s.levels, .buckets = s.buckets};
  if (!automatic) settings.cell_size = {x, y, z};
  if (const std::string wrong = problem(settings); !wrong.empty()) throw Error(wrong);
  return settings;
}

const collide::Method& method_of(const FinderSettings& settings) {
  if (const collide::Method* method = collide::find_method(settings.method)) return *method;
  throw Error("method '" + settings.method + "': unknown; use one of: " + collide::method_keys());
}

}  // namespace

std::vector<std::string> method_keys() {
  std::vector<std::string> keys;
  for (const collide::Method& method : collide::method_table()) keys.emplace_back(method.key);
  return keys;
}

struct ContactFinder::Impl {
  explicit Impl(const FinderSettings& s)
      : method(method_of(s)), settings(settings_of(s)), workers(threads_of(s.threads)), detector(method.make()) {}

  const collide::Method& method;
  collide::Settings settings;  // an automatic cell size is that of the first frame
  collide::Workers workers;
  std::unique_ptr<collide::Detector> detector;
  collide::Bodies bodies;
  Edges edges;  // of the last body
  std::vector<float> x, y, z;
  collide::Result result;
};

ContactFinder::ContactFinder(const FinderSettings& settings)
    : impl_(translated([&] { return std::make_unique<Impl>(settings); })) {}
ContactFinder::~ContactFinder() = default;
ContactFinder::ContactFinder(ContactFinder&&) noexcept = default;
ContactFinder& ContactFinder::operator=(ContactFinder&&) noexcept = default;

void ContactFinder::configure(const FinderSettings& settings) {
  translated([&] {
    auto changed = std::make_unique<Impl>(settings);
    changed->bodies = std::move(impl_->bodies);
    changed->edges = std::move(impl_->edges);
    impl_ = std::move(changed);
  });
}

Index ContactFinder::add_body(const BodyMesh& mesh) {
  return translated([&] {
    Impl& f = *impl_;
    if (!mesh.rest.empty() && mesh.rest.size() != 3 * std::size_t{mesh.vertices})
      throw Error("rest: " + std::to_string(mesh.rest.size()) + " numbers for " + std::to_string(mesh.vertices) +
                  " vertices; give three for each, or none");
    if (mesh.vertices > std::numeric_limits<Index>::max() - f.bodies.vertex_count())
      throw Error("vertices: all bodies together may have 4294967295");
    Edges edges = edges_of(mesh);
    // Copies of a mesh, one after another, share what depends on its edges.
    const bool same =
        f.bodies.count() > 0 && mesh.vertices == f.bodies.shape.back()->vertex_count() && edges == f.edges;
    const auto topology = same ? f.bodies.shape.back()->shared_topology()
                               : std::make_shared<const collide::Topology>(mesh.vertices, edges);
    f.bodies.add(std::make_shared<collide::Shape>(topology, positions_of(mesh.rest)));
    f.edges = std::move(edges);
    return f.bodies.count() - 1;
  });
}

void ContactFinder::clear_bodies() { impl_->bodies = {}; }
Index ContactFinder::bodies() const { return impl_->bodies.count(); }
Index ContactFinder::vertices() const { return impl_->bodies.vertex_count(); }

Index ContactFinder::body_of(Index vertex) const {
  if (vertex >= vertices()) throw Error("vertex " + std::to_string(vertex) + ": there is none");
  return impl_->bodies.body_of(vertex);
}

Detection ContactFinder::find(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
  return translated([&] {
    Impl& f = *impl_;
    f.result.contacts.clear();
    const collide::Frame frame{x, y, z, &f.bodies};
    if (!is_complete(frame))
      throw Error("find: " + std::to_string(x.size()) + ", " + std::to_string(y.size()) + " and " +
                  std::to_string(z.size()) + " coordinates; give one of each for all " + std::to_string(vertices()) +
                  " vertices");
    if (f.method.uses_hash && !f.settings.cell_size)
      f.settings.cell_size = collide::automatic_cell_size(frame, f.settings.levels, f.settings.tolerance);
    f.detector->detect(frame, f.settings, f.workers, f.result);
    return Detection{f.result.contacts, f.result.self_contacts, f.result.non_finite_bodies, f.method.exact,
                     f.result.counters.pair_tests};
  });
}

Detection ContactFinder::find(std::span<const float> xyz) {
  Impl& f = *impl_;
  const std::size_t count = vertices();
  if (xyz.size() != 3 * count)
    throw Error("find: " + std::to_string(xyz.size()) + " numbers; give three for each of " + std::to_string(count) +
                " vertices");
  f.x.resize(count), f.y.resize(count), f.z.resize(count);
  for (std::size_t i = 0; i < count; ++i) f.x[i] = xyz[3 * i], f.y[i] = xyz[3 * i + 1], f.z[i] = xyz[3 * i + 2];
  return find(f.x, f.y, f.z);
}

}  // namespace sbcollide
