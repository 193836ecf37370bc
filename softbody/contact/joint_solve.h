#pragma once
// Contacts that press on each other all at once: a heavy body on a light one that lies on a solid. Gauss and Seidel
// need about as many sweeps there as the one is heavier than the other; conjugate gradients need fewer.

#include <span>
#include <vector>

#include "softbody/contact/contact_row.h"

namespace softbody {

class JointSolver {
 public:
  static constexpr int max_sweeps = 256;

  /// Changes velocities until no contact misses its target by more than its slack, by nonsmooth nonlinear conjugate
  /// gradients (Silcowitz, Niebe and Erleben 2010). Contacts that are pushed out of an overlap can contradict each
  /// other where surfaces have crossed; where that shows, overlaps are only kept from growing, which all contacts can
  /// do. Returns the number of sweeps over all rows.
  int solve(std::span<ContactRow* const> rows, Field<float> v);

 private:
  struct Impulse {
    float normal = 0;  // N s
    glm::vec3 friction{0.0f};
  };
  static Impulse impulse_of(const ContactRow& row) { return {row.normal_impulse, row.friction_impulse}; }

  void start_again(std::span<ContactRow* const> rows, Field<float> v);
  static void set(ContactRow& row, const Impulse& to, Field<float> v);

  std::vector<Impulse> start_, before_, direction_;  // of each row
};

/// Returns true if a contact misses its target by more than its slack.
bool misses_target(const ContactRow& row, Field<const float> v);

}  // namespace softbody
