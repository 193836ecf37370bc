// The project's own world, with its default integrator.

#include "tests/bench/step/stepper.h"

#include "softbody/world/measures.h"

namespace bench {
namespace {

class Own final : public Stepper {
 public:
  Own(softbody::Scene scene, int steps, softbody::ContactSurface surface)
      : steps_(steps), world_(with(std::move(scene), surface), {.frame_time = 1.0 / frames_a_second / steps}) {}

  void step() override {
    for (int i = 0; i < steps_; ++i) world_.step();
  }
  bool finite() const override { return softbody::measure(world_).finite; }
  const softbody::World& state() override { return world_; }

 private:
  static softbody::Scene with(softbody::Scene scene, softbody::ContactSurface surface) {
    scene.contact_surface = surface;
    return scene;
  }

  int steps_;
  softbody::World world_;
};

}  // namespace

std::unique_ptr<Stepper> make_vertex_world(const softbody::Scene& scene, int steps) {
  return std::make_unique<Own>(scene, steps, softbody::ContactSurface::vertices);
}
std::unique_ptr<Stepper> make_surface_world(const softbody::Scene& scene, int steps) {
  return std::make_unique<Own>(scene, steps, softbody::ContactSurface::surfaces);
}

}  // namespace bench
