#include "tests/bench/step/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace bench {
namespace {

double energy_of(const softbody::Measures& m) { return m.energies.kinetic + m.energies.gravity; }

}  // namespace

std::vector<std::string> failures(const Figures& f) {
  std::vector<std::string> all;
  const auto check = [&](bool good, const std::string& text) {
    if (!good) all.push_back(text);
  };
  check(f.finite, "not finite");
  check(f.energy <= bounds.energy, fmt::format("energy + {:.2g}", f.energy));
  check(f.volume_min >= 1 / bounds.volume, fmt::format("volume down to {:.2g}", f.volume_min));
  check(f.volume_max <= bounds.volume, fmt::format("volume up to {:.2g}", f.volume_max));
  check(f.solid <= bounds.solid, fmt::format("{:.2g} R deep in a solid", f.solid));
  check(f.inside <= bounds.inside, fmt::format("{:.2g} R deep in a body", f.inside));
  if (f.lost > 0) all.push_back(fmt::format("given up at {:.3g} s", f.lost));
  return all;
}

Judge::Judge(const softbody::World& start) : energy_(energy_of(softbody::measure(start))) {
  radius_ = std::numeric_limits<double>::infinity();
  for (softbody::BodyId b = 0; b < start.bodies().count(); ++b) {
    const softbody::BodyModel& model = start.model(b);
    const double mass = model.particle_mass * double(model.mesh.vertices.size());
    mass_ += mass;
    scale_ += mass * 9.81 * model.radius;
    radius_ = std::min(radius_, model.radius);
  }
}

void Judge::look(const softbody::World& world, double seconds) {
  const softbody::Measures m = softbody::measure(world);
  if (!m.finite) return not_finite(seconds);
  figures_.energy = std::max(figures_.energy, (energy_of(m) - energy_) / scale_);
  figures_.volume_min = std::min(figures_.volume_min, m.volume_ratio_min);
  figures_.volume_max = std::max(figures_.volume_max, m.volume_ratio_max);
  figures_.solid = std::max(figures_.solid, m.deepest_penetration / radius_);
  figures_.speed = std::sqrt(2 * m.energies.kinetic / mass_);
  constexpr double hopeless = 10;
  if (figures_.energy > hopeless)
    figures_.lost = seconds;
  else if (++frame_ % frames_between == 0)
    look_inside(world);
}

void Judge::not_finite(double seconds) {
  figures_.finite = false;
  figures_.lost = seconds;
}

void Judge::look_inside(const softbody::World& world) {
  const collide::oracle::Overlaps overlaps = oracle_.overlaps(world);
  const collide::oracle::SurfaceFigures found = collide::oracle::figures_of(world.simulated().positions, overlaps);
  figures_.inside = std::max(figures_.inside, found.deepest / radius_);
  figures_.vertices_inside = std::max(figures_.vertices_inside, found.penetrating_vertices);
}

}  // namespace bench
