// A body moves the same to the bit by itself and as one of a block, with every instruction set, and by itself takes no
// room for others. Few take little.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "softbody/contact/kernels.h"
#include "softbody/mechanics/kernels.h"
#include "softbody/state/kernels.h"
#include "softbody/world/snapshot.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"
#include "tests/support/change.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// So many lanes of a field, by themselves.
struct NarrowField {
  NarrowField(const LaneField& all, int first, int width) {
    for (std::size_t s = std::size_t(first); s < all.x.size(); s += lanes)
      for (std::size_t l = s; l < s + std::size_t(width); ++l)
        x.push_back(all.x[l]), y.push_back(all.y[l]), z.push_back(all.z[l]);
  }
  LaneArray<float> x, y, z;
  Field<float> field() { return {x.data(), y.data(), z.data()}; }
  Field<const float> constant() const { return {x.data(), y.data(), z.data()}; }
  bool operator==(const NarrowField&) const = default;
};

bool same_bits(float a, float b) { return !std::memcmp(&a, &b, sizeof a); }

/// A small mesh in every lane, out of shape, and what the kernels ask for besides.
class EveryKernel : public tests::OnEveryTarget {
 protected:
  EveryKernel() : x(n), v(n), f(n) {
    for (int l = 0; l < lanes; ++l) moves[l] = l % 5 == 1 ? 0.0f : 1.0f;
    for (LaneField* field : {&x, &v, &f}) field->randomise(random, 0.2);
    for (std::size_t i = 0; i < n; ++i)
      for (int l = 0; l < lanes; ++l) x.set(i, l, x.at(i, l) + mesh.vertices[i]);
  }

  /// What `run` makes of all lanes with the simplest instructions, and of blocks of every width with those of the test.
  using Results = float[15][lanes];
  template <class Run>
  void expect_the_same(const Run& run) {
    LaneField all_x = x, all_v = v, all_f = f;
    Results result{};
    {
      const tests::UseTarget simplest(tests::targets().back());
      run(lanes, 0, all_x.field(), all_v.field(), all_f.field(), result);
    }
    const tests::UseTarget own(GetParam());
    for (int width = one_lane; width <= lanes; width = next_width(width))
      for (int first = 0; first < lanes; first += width) {
        NarrowField own_x(x, first, width), own_v(v, first, width), own_f(f, first, width);
        Results own_result;
        for (auto& row : own_result)
          for (int l = 0; l < lanes; ++l) row[l] = l < width ? 0 : -1.0f - float(l);
        run(width, first, own_x.field(), own_v.field(), own_f.field(), own_result);
        EXPECT_TRUE(own_x == NarrowField(all_x, first, width)) << first << " of " << width;
        EXPECT_TRUE(own_v == NarrowField(all_v, first, width)) << first << " of " << width;
        EXPECT_TRUE(own_f == NarrowField(all_f, first, width)) << first << " of " << width;
        for (std::size_t k = 0; k < std::size(result); ++k)
          for (int l = 0; l < lanes; ++l)
            EXPECT_TRUE(same_bits(own_result[k][l], l < width ? result[k][first + l] : -1.0f - float(l)))
                << own_result[k][l] << " in place " << k << ", lane " << first << " + " << l << " of " << width;
      }
  }

  std::mt19937 random{11};
  const std::shared_ptr<const BodyModel> model = make_unbalanced_body_model({.subdivisions = 1}, every_force());
  const Mesh& mesh = model->mesh;
  const std::size_t n = mesh.vertices.size();
  LaneField x, v, f;
  float moves[lanes];
};

using Values = Field<float>;

TEST_P(EveryKernel, GivesTheSameBitsForForces) {
  const auto bodies = [&](int width, Values xs, Values fs) { return LaneBodies<float>{*model, width, xs, fs}; };
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    SCOPED_TRACE(F::key);
    if constexpr (HasElements<F>)
      expect_the_same([&](int width, int, Values xs, Values vs, Values fs, Results&) {
        force_kernels(width).add[index_of<F>](bodies(width, xs, fs), {vs});
      });
    if constexpr (is_projected<F>())
      expect_the_same([&](int width, int first, Values xs, Values vs, Values, Results&) {
        LaneField room(n);
        force_kernels(width).project[index_of<F>](bodies(width, xs, {}),
                                                  {0.01f, moves + first, xs, vs, room.field(), nullptr});
      });
  });
  expect_the_same([&](int width, int, Values xs, Values, Values fs, Results& results) {
    SurfaceShape shapes[lanes];
    for (float* component : {fs.x, fs.y, fs.z}) std::fill_n(component, n * std::size_t(width), 0.0f);
    force_kernels(width).measure_surfaces(bodies(width, xs, fs), shapes);
    for (int l = 0; l < width; ++l) {
      const SurfaceShape& s = shapes[l];
      for (int k = 0; const double value : {s.volume, s.area2, s.stretch, s.two_medians})
        results[k++][l] = float(value);
    }
  });
}

TEST_P(EveryKernel, GivesTheSameBitsForMotion) {
  expect_the_same([&](int width, int first, Values, Values vs, Values fs, Results&) {
    state_kernels(width).kick(width, {n, 1, 0.5f, 0.25f, -1, 2, moves + first}, fs, vs);
  });
  expect_the_same([&](int width, int first, Values xs, Values vs, Values, Results&) {
    state_kernels(width).add(width, n, moves + first, 0.125f, vs, xs);
  });
  expect_the_same([&](int width, int, Values xs, Values vs, Values, Results& results) {
    Extent e;
    state_kernels(width).extent(width, n, xs, vs, e);
    for (int k = 0; const float* values : {e.lo.x, e.lo.y, e.lo.z, e.hi.x, e.hi.y, e.hi.z, e.length2, e.sum2})
      std::copy_n(values, width, results[k++]);
  });
}

TEST_P(EveryKernel, UnpacksOneBodyAfterAnother) {
  DoubleLaneVector offset;
  for (int l = 0; l < lanes; ++l) offset.set(std::size_t(l), {1e3 + l, -7.3 * l, 0.1});
  for (int width = one_lane; width <= lanes; width = next_width(width))
    for (int used = 1; used <= width; ++used) {
      NarrowField own(x, 0, width);
      std::vector<float> to[3];
      for (auto& component : to) component.assign(std::size_t(used) * n + 4, -1.0f);
      std::size_t first[lanes];
      for (int l = 0; l < used; ++l) first[l] = std::size_t(used - 1 - l) * n;
      state_kernels(width).unpack(std::size_t(used), n, own.constant(), offset, first,
                                  {to[0].data(), to[1].data(), to[2].data()});
      for (int l = 0; l < used; ++l)
        for (std::size_t i = 0; i < n; ++i) {
          const glm::vec3 expected(offset[std::size_t(l)] + x.at(i, l));
          for (int k = 0; k < 3; ++k) ASSERT_TRUE(same_bits(to[k][first[l] + i], expected[k])) << l << " of " << used;
        }
      for (const auto& component : to)
        for (std::size_t i = std::size_t(used) * n; i < component.size(); ++i)
          EXPECT_EQ(component[i], -1) << "written to";
    }
}

TEST_P(EveryKernel, GivesTheSameBitsForRigidMotion) {
  expect_the_same([&](int width, int, Values xs, Values vs, Values, Results& results) {
    RigidSums s;
    state_kernels(width).rigid_sums(width, n, xs, vs, s);
    for (int k = 0; const DoubleLaneVector* sum : {&s.place, &s.velocity, &s.momentum, &s.square, &s.mixed})
      for (const double* component : {sum->x, sum->y, sum->z}) std::copy_n(component, width, results[k++]);
  });
  expect_the_same([&](int width, int first, Values xs, Values vs, Values, Results&) {
    RigidChange change{};
    for (int l = 0; l < width; ++l) {
      change.acts[l] = moves[first + l];
      change.keep[l] = 0.9;
      change.push.x[l] = 0.1 * (first + l), change.spin.y[l] = 3, change.about.z[l] = 0.25;
    }
    state_kernels(width).change_rigidly(width, n, change, xs, vs);
  });
}

TEST_P(EveryKernel, GivesTheSameBitsForSolids) {
  const SolidShape<float> shapes[]{
      SphereShape<float>{0.4f}, PlaneShape<float>{{0, 1, 0}},
      BoxShape<float>{{{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}}, {0.5f, 0.2f, 1}, 0.01f},
      CapsuleShape<float>{{1, 0, 0.25f}, 0.2f}};
  for (const auto& one : shapes) {
    unsigned acted = 0;
    expect_the_same([&](int width, int first, Values xs, Values vs, Values fs, Results& results) {
      float* const returned = results[0];
      LaneVector impulse{};
      float work[lanes]{};
      SolidArguments solid{n, 0.02f, 0.5f, 0.25f, one, {}, moves + first, {field(impulse), returned, work}};
      for (int l = 0; l < width; ++l) returned[l] = 0, solid.place.y[l] = -0.45f + 0.01f * float(first + l);
      solid.h = 0.01f;
      solid.before = fs;
      const unsigned now = act_by_solid(width, width, solid, xs, vs);
      if (acted == 0) acted = now;  // of all lanes
      EXPECT_EQ(now, acted >> first & ((1u << width) - 1));
      for (int l = 0; l < width; ++l) fs.x[l] = impulse.x[l], fs.y[l] = impulse.y[l], fs.z[l] = impulse.z[l];
    });
    EXPECT_NE(acted, 0u) << "or the solid took no part";
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryKernel, testing::ValuesIn(tests::targets()), tests::target_name);

int width_of(const World& world, BodyId body) { return WorldTestAccess::solver(world).state().batch_of(body).width; }

/// A ball just above the ground and one of another material just above it, both falling.
Scene two_balls(ContactSurface surface) {
  Material m = gas_ball();
  m[Material::mass] = 4;
  m[GasPressure::inside] = 1200;
  m[GasPressure::outside] = 1000;
  m[Material::internal_damping] = 2;
  m[contact::rebound_speed] = 1;
  m[Material::start_in_equilibrium] = false;
  Scene scene = lone_body(m, {0, -1, 0});
  m.name = "other";
  m[contact::friction] = 0.3;
  scene.materials.push_back(m);
  scene.contact_surface = surface;
  scene.collision.self_collision = true;
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{}});
  scene.bodies[0].position = {0, 0.51, 0};
  add_body(scene, {0.1, 1.515, 0}, {0, -3, 0});
  scene.bodies[1].material = 1;
  return scene;
}

constexpr int few_lanes = next_width(one_lane);

/// Others like the body `id`, far away, come and go: what is left has a wider block from then on.
void visit(World& world, BodyId id, int others = 1) {
  BodySource other = world.scene().bodies[id];
  std::vector<BodyId> visitors;
  for (int i = 0; i < others; ++i) {
    other.position = {20 + 3 * i, 3, 0};
    visitors.push_back(world.add(other));
  }
  for (; !visitors.empty(); visitors.pop_back()) world.remove(visitors.back());
}

struct Case {
  std::string integrator;
  ContactSurface surface;
};

class TwoBodies : public testing::TestWithParam<Case> {};

TEST_P(TwoBodies, MoveTheSameByThemselvesAndInLanes) {
  const bool slow = GetParam().integrator == "explicit-euler";  // it would ask for hundreds of substeps
  const World::Options options{
      .threads = 2, .integrator = {GetParam().integrator, slow ? std::optional(60) : std::nullopt}, .least_share = 0};
  const Scene scene = two_balls(GetParam().surface);
  World solo(scene, options), mixed(scene, options), wide(scene, options);
  visit(mixed, 1);
  visit(wide, 0, 5);
  visit(wide, 1, 8);
  EXPECT_EQ(std::pair(width_of(solo, 0), width_of(solo, 1)), std::pair(one_lane, one_lane));
  EXPECT_EQ(std::pair(width_of(mixed, 0), width_of(mixed, 1)), std::pair(one_lane, few_lanes));
  EXPECT_EQ(std::pair(width_of(wide, 0), width_of(wide, 1)), std::pair(lanes / 2, lanes));
  std::size_t touched = 0;
  for (int frame = 0; frame < 12; ++frame) {
    for (World* world : {&solo, &mixed, &wide}) {
      world->step();
      if (frame == 8) visit(*world, 1);  // while it is touched
      const auto touches = [](const World& w) { return w.surface_contacts().size(); };
      ASSERT_EQ(world->state_hash(), solo.state_hash()) << "frame " << frame;
      ASSERT_EQ(world->last_step().substeps, solo.last_step().substeps);
      ASSERT_EQ(solid_contacts(*world).size(), solid_contacts(solo).size());
      ASSERT_EQ(touches(*world), touches(solo));
      ASSERT_EQ(WorldTestAccess::penalty_energy(*world), WorldTestAccess::penalty_energy(solo));
      touched += touches(*world) + world->detection().contacts.size();
    }
  }
  EXPECT_TRUE(measure(solo).finite);
  EXPECT_GT(touched, 0u);
  EXPECT_FALSE(solid_contacts(solo).empty());
  EXPECT_EQ(std::pair(width_of(solo, 0), width_of(solo, 1)), std::pair(one_lane, few_lanes));
}

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const Integrator& integrator : integrators())
    for (const ContactSurfaceInfo& surface : contact_surfaces)
      list.push_back({std::string(integrator.key), surface.value});
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, TwoBodies, testing::ValuesIn(cases()), [](const auto& one) {
  std::string name = one.param.integrator + (one.param.surface == ContactSurface::surfaces ? "_surfaces" : "_vertices");
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(LoneBody, IsChangedTheSameAtEitherWidth) {
  const Scene scene = two_balls(ContactSurface::vertices);
  World narrow(scene, {}), wide(scene, {});
  visit(wide, 0);
  visit(wide, 1);
  for (World* world : {&narrow, &wide}) {
    run(*world, 4);
    Material soft = scene.materials[0];
    soft[StructuralSprings::stiffness] = 100;
    change(*world, [&](Scene& s) { s.materials[0] = soft; });
    world->grab(Grab{.body = 1, .target = {1, 2, 0}});
    run(*world, 4);
    world->grab({});
    std::vector<Particle> moved;
    for (Index i = 0; i < world->model(0).mesh.vertices.size(); ++i) {
      moved.push_back(world->particle(0, i));
      moved.back().position += glm::dvec3(30, 0, 0);
    }
    world->set_particles(0, moved);
    run(*world, 4);
  }
  EXPECT_EQ(std::pair(width_of(narrow, 0), width_of(wide, 0)), std::pair(one_lane, few_lanes));
  EXPECT_EQ(narrow.state_hash(), wide.state_hash());
}

TEST(LoneBody, TakesAPlaceThatOneLeft) {
  Scene scene = two_balls(ContactSurface::vertices);
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[2].position = {9, 3, 0};
  World world(scene, {});
  EXPECT_EQ(std::pair(width_of(world, 0), width_of(world, 1)), std::pair(few_lanes, one_lane));
  world.remove(1);
  EXPECT_EQ(width_of(world, world.add(scene.bodies[1])), one_lane);
  EXPECT_EQ(WorldTestAccess::solver(world).state().batches().size(), 2u);
}

TEST(Block, TakesNoRoomForOthers) {
  for (const int bodies : {1, lanes}) {
    Scene scene = lone_body(gas_ball());
    for (int i = 1; i < bodies; ++i) add_body(scene, {2.0 * i, 0, 0}, glm::dvec3(0.0));
    const World world(scene, {});
    EXPECT_EQ(width_of(world, 0), bodies == 1 ? one_lane : lanes);
    const std::size_t motion = world.bodies().vertex_count() * 6 * sizeof(float);  // positions and velocities
    EXPECT_LE(world.snapshot().bytes(), motion + 4096 + 512 * std::size_t(bodies));
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
