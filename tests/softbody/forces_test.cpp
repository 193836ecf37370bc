// All forces inside bodies, as they stand in the table: a new one is tested by its being there.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/mechanics/deformation.h"
#include "softbody/mechanics/force_set.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

using Places = std::vector<glm::dvec3>;

/// A sheet of quads, which has springs of all kinds, or a ball, which may hold gas.
MeshSource mesh_of(Coordinate coordinate) {
  MeshSource source{.subdivisions = 0};
  if (coordinate == Coordinate::length) source.kind = "grid", source.columns = source.rows = 2;
  return source;
}

/// A model with one force, and bodies in random shapes and motion, one in each lane.
template <class F>
struct Rig {
  Rig() {
    for (LaneField* field : {&x, &v}) field->randomise(random, 0.15);
    for (std::size_t i = 0; i < n; ++i)
      for (int l = 0; l < lanes; ++l) x.set(i, l, x.at(i, l) + (0.6 + 0.1 * l) * model.mesh.vertices[i]);
  }
  /// The forces in double on the body in a lane; h: of an implicit step in which it has gone by h v, or 0 at rest.
  Places exact(const Places& at, int lane, double h = 0) const {
    Lanes now(3 * n * implicit_lanes), before(now.size()), none(now.size()), f(now.size());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < std::size_t(implicit_lanes); ++l) {
        write(now, i * implicit_lanes + l, at[i]);
        write(before, i * implicit_lanes + l, at[i] - h * v.at(i, lane));
      }
    const LaneBodies<double> bodies{model, implicit_lanes, field(std::as_const(now)), field(f)};
    HeldForces held{};
    implicit_force_kernels().hold(bodies, held);
    const double rate = h > 0 ? 1 / h : 0;
    implicit_force_kernels().add(bodies, held, {rate, field(std::as_const(before)), field(std::as_const(none)), 1});
    Places forces;
    for (std::size_t i = 0; i < n; ++i) forces.push_back(read(f, i * implicit_lanes));
    return forces;
  }
  Places places(int lane) const {
    Places list;
    for (std::size_t i = 0; i < n; ++i) list.push_back(x.at(i, lane));
    return list;
  }
  /// The derivative of minus the forces by the positions or, at h, by the velocities.
  Eigen::MatrixXd matrix(int lane) const {
    constexpr double e = 1e-6;
    Eigen::MatrixXd m(3 * n, 3 * n);
    for (std::size_t j = 0; j < 3 * n; ++j) {
      Places more = places(lane), less = more;
      more[j / 3][int(j % 3)] += e, less[j / 3][int(j % 3)] -= e;
      const Places up = exact(more, lane), down = exact(less, lane);
      for (std::size_t i = 0; i < 3 * n; ++i)
        m(Eigen::Index(i), Eigen::Index(j)) = -(up[i / 3][int(i % 3)] - down[i / 3][int(i % 3)]) / (2 * e);
    }
    return m;
  }

  std::mt19937 random{5};
  const BodyModel model = only<F>(*make_unbalanced_body_model(mesh_of(F::coordinate), every_force()));
  const std::size_t n = model.mesh.vertices.size();
  LaneField x{n}, v{n};
};

double size_of(const Places& forces) {
  double most = 0;
  for (const glm::dvec3& f : forces) most = std::max(most, glm::length(f));
  return most;
}

/// Calls test(Rig<F>) for each force that has elements.
template <class Test>
void for_each_rig(const Test& test) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (HasElements<F>) {
      SCOPED_TRACE(F::key);
      test(Rig<F>{}, Name<F>{});
    }
  });
}

TEST(Forces, AreMinusTheGradientOfTheirEnergy) {
  for_each_rig([]<class F>(const Rig<F>& rig, Name<F>) {
    const auto energy = [&](const Places& at) { return stored_energy(rig.model, at).total(); };
    for (const int lane : {0, lanes - 1}) {
      const Places at = rig.places(lane), forces = rig.exact(at, lane);
      Places pushed;
      constexpr double e = 1e-5;
      for (std::size_t i = 0; i < rig.n; ++i)
        for (int k = 0; k < 3; ++k) {
          Places more = at, less = at;
          more[i][k] += e, less[i][k] -= e;
          EXPECT_NEAR(forces[i][k], -(energy(more) - energy(less)) / (2 * e), 1e-6 * size_of(forces) + 1e-9);
          EXPECT_NEAR(stored_energy_change(rig.model, less, more).total(), energy(more) - energy(less),
                      1e-9 * (1 + std::abs(energy(more))));
        }
    }
  });
}

/// With their dampers: an implicit step that has led along h v sees the same as velocities v, up to first order.
TEST(Forces, InLanesAreTheExactOnesOnEveryTarget) {
  for (const std::int64_t target : tests::targets()) {
    const tests::UseTarget use(target);
    for_each_rig([]<class F>(const Rig<F>& rig, Name<F>) {
      LaneField f(rig.n);
      force_kernels(lanes).add[index_of<F>]({rig.model, lanes, rig.x.field(), f.field()}, {rig.v.field()});
      for (int l = 0; l < lanes; ++l) {
        const Places exact = rig.exact(rig.places(l), l, 1e-7);
        EXPECT_GT(size_of(exact), 0);
        for (std::size_t i = 0; i < rig.n; ++i)
          EXPECT_LT(glm::distance(f.at(i, l), exact[i]), 1e-5 * size_of(exact)) << "particle " << i << ", lane " << l;
      }
    });
  }
}

TEST(Forces, ThatAreInternalHaveNoSumAndNoTorque) {
  for_each_rig([]<class F>(const Rig<F>& rig, Name<F>) {
    for (int l = 0; l < lanes; ++l) {
      const Places at = rig.places(l), forces = rig.exact(at, l, 1e-3);
      glm::dvec3 sum(0.0), torque(0.0);
      for (std::size_t i = 0; i < rig.n; ++i) sum += forces[i], torque += glm::cross(at[i], forces[i]);
      const double error = std::max(glm::length(sum), glm::length(torque)), scale = size_of(forces) * double(rig.n);
      if (F::internal)
        EXPECT_LT(error, 1e-2 * 1e-3 * scale) << "lane " << l;
      else
        EXPECT_GT(error, 1e-6 * scale) << "lane " << l << ": then nothing need treat it as external";
    }
  });
}

TEST(Forces, AreNoStifferAndDampNoMoreThanTheirBounds) {
  for_each_rig([]<class F>(const Rig<F>& rig, Name<F>) {
    for (int l = 0; l < lanes; l += 3) {
      const Eigen::MatrixXd m = rig.matrix(l);
      const double largest =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((m + m.transpose()) / 2).eigenvalues().maxCoeff();
      const double bound = 2 * stiffness_per_mass(rig.model, measure_surface(rig.model, rig.places(l)));
      EXPECT_LE(largest / rig.model.particle_mass, bound * (1 + 1e-6) + 1e-6) << "lane " << l;
    }
    // A damper's force for a motion is no more than the bound times the motion.
    const double h = 1e-3;
    for (int l = 0; l < lanes; ++l) {
      const Places at = rig.places(l), with = rig.exact(at, l, h), without = rig.exact(at, l);
      double force2 = 0, speed2 = 0;
      for (std::size_t i = 0; i < rig.n; ++i) {
        force2 += glm::dot(with[i] - without[i], with[i] - without[i]);
        speed2 += glm::dot(rig.v.at(i, l), rig.v.at(i, l));
      }
      EXPECT_LE(std::sqrt(force2 / speed2), 2 * damping_bound(rig.model) * (1 + 1e-6) + 1e-9) << "lane " << l;
    }
  });
}

}  // namespace THIS_FILE
}  // namespace softbody::test
