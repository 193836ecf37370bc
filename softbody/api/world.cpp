// The public interface of a world.

#include "collide/api/guarded.h"
#include "softbody/api/scene_impl.h"
#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace sbcollide {
namespace {

softbody::World::Options options_of(const WorldSettings& settings) {
  const int threads = threads_of(settings.threads);
  if (!(settings.frame_time >= 1e-6 && settings.frame_time <= 1)) throw Error("frame_time: must be from 1e-6 to 1 s");
  if (!softbody::find_integrator(settings.integrator))
    throw Error("integrator '" + settings.integrator + "': unknown; use one of: " + softbody::integrator_keys());
  return {.threads = threads, .frame_time = settings.frame_time, .integrator = {.key = settings.integrator}};
}

}  // namespace

struct World::Impl {
  softbody::World world;
  std::vector<softbody::MeshSource> meshes;

  void require_body(Index body) const {
    if (body >= world.bodies().count()) throw Error("body " + std::to_string(body) + ": there is none");
  }
};

World::World(const Scene& scene, const WorldSettings& settings)
    : impl_(translated([&] {
        return std::unique_ptr<Impl>(
            new Impl{softbody::World(scene.impl_->make(), options_of(settings)), scene.impl_->meshes});
      })) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step() {
  translated([&] { impl_->world.step(); });
}

Index World::add_body(const Body& body) {
  return translated([&] { return impl_->world.add(body_source(body, impl_->meshes, impl_->world.scene().materials)); });
}

int World::frame() const { return impl_->world.frame(); }
double World::time() const { return impl_->world.last_step().time; }
Index World::bodies() const { return impl_->world.bodies().count(); }

Index World::first_vertex(Index body) const {
  impl_->require_body(body);
  return impl_->world.bodies().first[body];
}

std::span<const std::array<Index, 3>> World::triangles(Index body) const {
  impl_->require_body(body);
  return impl_->world.model(body).shown().mesh.triangles;
}

Positions World::positions() const {
  const collide::Frame at = impl_->world.positions();
  return {at.x, at.y, at.z};
}

std::vector<Vector> World::velocities() const {
  const softbody::World& world = impl_->world;
  std::vector<Vector> all;
  for (Index body = 0; body < bodies(); ++body) {
    const auto& fine = world.model(body).fine;
    const auto velocity = [&](Index vertex) {
      if (!fine) return world.particle(body, vertex).velocity;
      const softbody::Embedding::Hold& hold = fine->embedding()[vertex];
      glm::dvec3 sum(0.0);
      for (int k = 0; k < 3; ++k)
        sum += double{hold.weight[k]} * world.particle(body, hold.corner[std::size_t(k)]).velocity;
      return sum;
    };
    for (Index vertex = 0; vertex < world.bodies().size(body); ++vertex) {
      const glm::dvec3 v = velocity(vertex);
      all.push_back({v.x, v.y, v.z});
    }
  }
  return all;
}

std::span<const Contact> World::contacts() const { return impl_->world.detection().contacts; }

Energies World::energies() const {
  const softbody::Energy e = softbody::measure(impl_->world).energies;
  return {e.kinetic, e.elastic, e.gas, e.gravity};
}

bool World::finite() const { return softbody::measure(impl_->world).finite; }
bool World::at_rest() const { return impl_->world.all_at_rest(); }
std::uint64_t World::state_hash() const { return impl_->world.state_hash(); }

}  // namespace sbcollide
