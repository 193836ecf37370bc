#pragma once
// Small worlds with surface contact, and their judge.

#include <gtest/gtest.h>

#include "collide/oracle/surface_oracle.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {

inline Material rubber(double friction = 0.5) {
  Material m = gas_ball();
  m[Material::thickness] = 0.005;
  m[contact::friction] = friction;
  return m;
}

/// One ball of 0.5 m without gravity or solids.
inline Scene ball_in_space(const Material& material, const glm::dvec3& velocity = glm::dvec3(0.0)) {
  Scene scene = lone_body(material, velocity);
  scene.contact_surface = ContactSurface::surfaces;
  scene.collision.self_collision = true;
  return scene;
}

/// The exact oracle, frame by frame.
class Judge {
 public:
  explicit Judge(const World& world) : world_(world) {
    for (BodyId b = 0; b < world.bodies().count(); ++b) surfaces_.push_back(world.model(b).surface);
  }
  /// What overlaps now.
  collide::oracle::SurfaceFigures look() {
    const collide::Frame at = world_.simulated().positions;
    return collide::oracle::figures_of(at, collide::oracle::find_overlaps(at, surfaces_, workers_));
  }
  void expect_clean(const std::string& when) {
    const collide::oracle::SurfaceFigures f = look();
    EXPECT_EQ(f.penetrating_vertices, 0u) << when << ", deepest " << f.deepest;
    EXPECT_EQ(f.piercings, 0u) << when;
  }

 private:
  const World& world_;
  collide::surface::Surfaces surfaces_;
  collide::Workers workers_{1};
};

inline std::string frame_of(const World& world) { return "frame " + std::to_string(world.frame()); }

}  // namespace softbody::test
