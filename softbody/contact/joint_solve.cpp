#include "softbody/contact/joint_solve.h"

#include <algorithm>

namespace softbody {

bool misses_target(const ContactRow& row, Field<const float> v) {
  return row.target - glm::dot(relative_velocity(row, v), row.normal) > row.slack;
}

/// Takes back what contacts have done that contradict each other, and asks less of them.
void JointSolver::start_again(std::span<ContactRow* const> rows, Field<float> v) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    set(*rows[i], start_[i], v);
    rows[i]->target = std::min(rows[i]->target, 0.0f);
  }
  before_ = start_;
  direction_.assign(rows.size(), {});
}

void JointSolver::set(ContactRow& row, const Impulse& to, Field<float> v) {
  apply(row, (to.normal - row.normal_impulse) * row.normal + (to.friction - row.friction_impulse), v);
  row.normal_impulse = to.normal;
  row.friction_impulse = to.friction;
}

int JointSolver::solve(std::span<ContactRow* const> rows, Field<float> v) {
  constexpr int watched = 32;  // sweeps
  start_.clear();
  for (const ContactRow* row : rows) start_.push_back(impulse_of(*row));
  before_ = start_;
  direction_.assign(rows.size(), {});
  double last_square = 0, watched_square = 0;
  for (int sweep = 1;; ++sweep) {
    double square = 0;  // of the change, in the norm of the kinetic energy
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ContactRow& row = *rows[i];
      before_[i] = impulse_of(row);
      solve_row(row, v);
      const float push = row.normal_impulse - before_[i].normal;
      const glm::vec3 drag = row.friction_impulse - before_[i].friction;
      square += double(push * push + glm::dot(drag, drag)) / double(row.mass);
    }
    if (sweep == max_sweeps || std::ranges::none_of(rows, [&](ContactRow* r) { return misses_target(*r, v); }))
      return sweep;
    if (sweep % watched == 0) {
      if (sweep > watched && square > 0.9 * watched_square) start_again(rows, v);
      watched_square = square;
    }
    const float go_on = sweep > 1 && square < last_square ? float(square / last_square) : 0;
    last_square = square;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ContactRow& row = *rows[i];
      Impulse& d = direction_[i];
      const Impulse further{go_on * d.normal, go_on * d.friction}, now = impulse_of(row);
      const float normal = std::max(0.0f, now.normal + further.normal);
      set(row, {normal, normal > 0 ? now.friction + further.friction : glm::vec3(0.0f)}, v);
      d = {further.normal + (now.normal - before_[i].normal), further.friction + (now.friction - before_[i].friction)};
    }
  }
}

}  // namespace softbody
