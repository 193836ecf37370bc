// Rows of particles on a line, above a wall.

#include <gtest/gtest.h>

#include <algorithm>

#include "softbody/contact/joint_solve.h"

namespace softbody::test {
namespace THIS_FILE {

/// Particles one above the other; the wall is below the first.
struct Stack {
  std::vector<float> mass, x, y, z;
  std::vector<ContactRow> rows;

  Stack(const std::vector<float>& masses, float speed)
      : mass(masses), x(masses.size()), y(masses.size(), speed), z(masses.size()) {
    for (std::uint32_t i = 0; i < mass.size(); ++i) add(i, i);
  }
  /// A row that keeps particle `above` off the one below `upper`, or off the wall.
  void add(std::uint32_t above, std::uint32_t upper, float direction = 1, float target = 0) {
    ContactRow& row = rows.emplace_back();
    const std::uint32_t below = upper == 0 ? above : upper - 1;
    row.slot = {above, below, below, below};
    row.weight = {1, upper == 0 ? 0.0f : -1.0f, 0, 0};
    row.mobility = {1 / mass[above], row.weight[1] / mass[below], 0, 0};
    row.normal = {0, direction, 0};
    row.mass = 1 / (row.mobility[0] - row.mobility[1]);
    row.target = target;
    row.slack = 1e-3f;
  }
  Field<float> v() { return {x.data(), y.data(), z.data()}; }
  int solve() {
    std::vector<ContactRow*> all;
    for (ContactRow& row : rows) all.push_back(&row);
    return JointSolver().solve(all, v());
  }
  double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += double(mass[i] * y[i] * y[i]) / 2;
    return sum;
  }
};

TEST(JointSolver, StopsAHeavyParticleOnLightOnesInHalfTheSweepsOfGaussAndSeidel) {
  for (const float ratio : {30.0f, 100.0f}) {
    Stack stack({1, 1, 1, ratio}, -4);
    const double before = stack.energy();
    Stack plain = stack;
    int sweeps = 0;
    while (std::ranges::any_of(plain.rows, [&](const ContactRow& row) { return misses_target(row, plain.v()); }))
      for (ContactRow& row : (++sweeps, plain.rows)) solve_row(row, plain.v());
    EXPECT_LT(stack.solve(), sweeps / 2) << ratio;
    for (const ContactRow& row : stack.rows) EXPECT_FALSE(misses_target(row, stack.v())) << ratio;
    EXPECT_LT(stack.energy(), 1e-4 * before) << ratio;
  }
}

/// Two rows of one particle that want it to go both ways.
TEST(JointSolver, AddsNoEnergyWhereContactsContradictEachOther) {
  Stack stack({1, 1}, 0);
  stack.add(0, 0, 1, 1);
  stack.add(0, 0, -1, 1);
  EXPECT_LT(stack.solve(), JointSolver::max_sweeps);
  EXPECT_LT(stack.energy(), 1e-6);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
