// Worlds of every value that a scene file may hold, in frames of any length, under changing hands: such a scene reads
// back as it was written, is refused in one line or moves, stays finite in every step that the program chooses by
// itself, and goes on from a snapshot to the bit, also in a world of other threads and instructions. Fine meshes, which
// only code can make here, follow the coarse ones that are simulated.

#include <hwy/targets.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>
#include <vector>

#include "collide/core/vertex_run.h"
#include "random_scene.h"
#include "require.h"
#include "softbody/model/body_model.h"
#include "softbody/scene/scene.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/world/measures.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"
#include "tests/support/change.h"
#include "text_file.h"

namespace fuzz {
namespace {

// An input ends at the first of them: one that takes many substeps has shown in few frames what it can.
constexpr int most_frames = 12, most_substeps = 1000;
// Far less than users may ask for: frames that take longer end sooner, and every input takes its turn.
constexpr softbody::WorkBudget budget{.least = 3e5, .per_particle = 30};

void require_one_line(const softbody::SceneError& error) {
  require(std::string_view(error.what()).find('\n') == std::string_view::npos, "a refusal of several lines");
}

/// Written and read.
softbody::Scene through_file(const softbody::Scene& scene, TextFile& file) {
  const std::string text = softbody::scene_toml(scene, {});
  return softbody::load_scene(file.write(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

/// One change by hand. What is refused has changed nothing.
void change(softbody::World& world, Bytes& bytes) {
  const std::uint64_t before = world.state_hash();
  const auto count = int(world.bodies().count());
  try {
    switch (bytes.below(12)) {
      case 0:
        world.drop(1 + bytes.below(2));
        break;
      case 1:
        world.throw_body(read_vector(bytes, 1), read_vector(bytes, 100) + glm::dvec3(0, 1e-3, 0));
        break;
      case 2:
        if (count > 0) world.remove(softbody::BodyId(bytes.below(count)));
        break;
      case 3: {
        const auto which = std::size_t(bytes.below(int(world.scene().materials.size())));
        softbody::change(world, [&](softbody::Scene& s) {
          s.materials[which] = read_material(bytes, world.scene().materials[which].name);
        });
        break;
      }
      case 4:
        softbody::change(world, [&](softbody::Scene& s) {
          s.gravity = read_vector(bytes, bytes.one_of({10.0, 0.0, softbody::max_gravity}));
        });
        break;
      case 5: {  // as in a window, whose mouse is not far from the body
        if (count == 0) break;
        const auto body = softbody::BodyId(bytes.below(count));
        world.grab(softbody::Grab{.body = body, .target = world.body(body).origin + read_vector(bytes, 2)});
        break;
      }
      case 6:
        world.grab({});
        break;
      case 7:
        softbody::change(world, [&](softbody::Scene& s) {
          s.contact_surface =
              bytes.below(2) == 0 ? softbody::ContactSurface::vertices : softbody::ContactSurface::surfaces;
        });
        break;
      case 8:
        world.add(read_body(bytes, int(world.scene().materials.size())));
        break;
      case 9: {
        const auto all = softbody::integrators();
        world.set_integrator({std::string(all[std::size_t(bytes.below(int(all.size())))].key)});
        break;
      }
      case 11:
        world.add(read_fine_body(bytes, int(world.scene().materials.size())));
        break;
      default:
        break;
    }
  } catch (const softbody::SceneError& error) {
    require_one_line(error);
    require(world.state_hash() == before, "a refused change has changed something");
  }
}

/// Requires of all fine vertices that they are no farther from their places on the coarse surface than at rest.
void require_followers(const softbody::World& world) {
  const collide::Frame fine = world.positions(), coarse = world.simulated().positions;
  const auto at = [](const collide::Frame& frame, softbody::BodyId body, softbody::Index vertex) {
    return glm::dvec3(collide::vertices_of(frame, body)[vertex]);
  };
  for (softbody::BodyId body = 0; body < world.bodies().count(); ++body) {
    if (!world.model(body).fine) continue;
    const softbody::Embedding& embedding = world.model(body).fine->embedding();
    for (softbody::Index v = 0; v < embedding.size(); ++v) {
      const softbody::Embedding::Hold& hold = embedding[v];
      glm::dvec3 foot(0.0);
      double farthest = 0;  // from the origin: floats round by its millionth
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 corner = at(coarse, body, hold.corner[std::size_t(k)]);
        foot += double(hold.weight[k]) * corner;
        farthest = std::max(farthest, glm::length(corner));
      }
      const double most = 1.001 * double(glm::length(hold.offset)) + 1e-6 * farthest;
      require(glm::distance(at(fine, body, v), foot) <= most, "a fine vertex does not follow");
    }
  }
}

/// Returns the state and what is shown of it.
auto outcome(const softbody::World& world) {
  const auto [x, y, z, bodies] = world.positions();
  return std::tuple(world.state_hash(), std::vector(x.begin(), x.end()), std::vector(y.begin(), y.end()),
                    std::vector(z.begin(), z.end()));
}

/// One step. At times it is done three times from a snapshot of before: here, here again and in a world of its own.
/// start: a scene that options are good for.
void step(softbody::World& world, bool thrice, const softbody::Scene& start, const softbody::World::Options& options) {
  if (!thrice) return world.step();
  const softbody::Snapshot snapshot = world.snapshot();
  world.step();
  const auto once = outcome(world);
  world.restore(snapshot);
  world.step();
  require(outcome(world) == once, "it goes on from a snapshot in another way");
  softbody::World::Options other_way = options;
  other_way.threads = 2;
  other_way.least_share = 0;
  hwy::SetSupportedTargetsForTest(HWY_STATIC_TARGET);  // code for any processor
  softbody::World twin(start, other_way);
  twin.restore(snapshot);
  twin.step();
  hwy::SetSupportedTargetsForTest(0);
  require(outcome(twin) == once, "two threads of baseline code go on in another way");
}

void run(Bytes bytes) {
  static TextFile file(".toml");
  softbody::Scene scene = read_scene(bytes, file.path().stem().string());
  require(through_file(scene, file) == scene, "a scene does not read back as it was written");
  softbody::World::Options options;
  options.budget = budget;
  const int choice = bytes.below(32);
  if (choice % 4 == 0) options.integrator.key = "implicit";
  if (choice >= 1 && choice <= 8) scene.bodies.push_back(read_fine_body(bytes, int(scene.materials.size())));
  options.frame_time = bytes.one_of({1.0 / 600, 1.0 / 600, 1.0 / 600, 1.0 / 60, 1.0 / 60, 0.0});
  if (options.frame_time == 0) options.frame_time = bytes.one_of({1e-6, 0.1, 1.0});
  std::optional<softbody::World> world;
  try {
    world.emplace(scene, options);
  } catch (const softbody::SceneError& error) {
    return require_one_line(error);
  }
  for (int frame = 0, substeps = 0; frame < most_frames && substeps < most_substeps; ++frame) {
    step(*world, bytes.below(8) == 0, scene, options);
    substeps += world->last_step().substeps;
    require(softbody::measure(*world).finite, "not finite");
    require_followers(*world);
    change(*world, bytes);
  }
}

}  // namespace
}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::run(fuzz::Bytes({data, size}));
  return 0;
}
