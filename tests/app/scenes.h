#pragma once
// Small scenes for the demo's tests, in motion from the first frame; how tests let them go on, and what they look for.

#include <chrono>
#include <limits>
#include <thread>

#include "collide/methods.h"
#include "softbody/world/bodies_in_motion.h"
#include "tests/solids.h"

namespace app {

using namespace tests;

inline constexpr double tick = 1.0001 / 60;  // s, a little more than a frame

/// Lets a session or a simulation go on for so many pictures, one a frame.
void run(auto& shown, int pictures) {
  for (int i = 0; i < pictures; ++i) shown.advance(tick);
}

/// Asks `done` again and again, because a thread works meanwhile. Returns false if it is not true within two minutes.
bool wait_until(const auto& done) {
  using namespace std::chrono;
  for (const auto end = steady_clock::now() + minutes(2); steady_clock::now() < end;) {
    if (done()) return true;
    std::this_thread::sleep_for(milliseconds(1));
  }
  return false;
}

/// Returns what a new detector of a method finds in a frame.
inline collide::Result detected(const collide::Method& method, const collide::Frame& frame,
                                const collide::Settings& settings) {
  collide::Workers alone(1);
  collide::Result result;
  method.make()->detect(frame, settings, alone, result);
  return result;
}

/// Returns the contacts that brute force finds in the present frame of a world.
std::vector<collide::Contact> true_contacts(const auto& world) {
  return detected(*collide::find_method(collide::reference_method), world.positions(), world.collision()).contacts;
}

/// Two bodies side by side in contact, in the air above a solid sphere and the ground, and a dropper.
inline softbody::Scene touching_pair() {
  softbody::Scene scene;
  scene.key = "pair";
  scene.name = "Touching pair";
  scene.collision.tolerance = 0.1f;
  softbody::Material& rubber = scene.materials.emplace_back();
  rubber.name = "rubber";
  rubber[softbody::Material::start_in_equilibrium] = false;
  softbody::BodySource left, right;
  left.position = {-0.51, 3, 0.03};
  right.position = {0.51, 3, 0};
  scene.bodies = {left, right};
  scene.solids = {{softbody::SolidSphere{}}, {softbody::Ground{}}};
  softbody::BodySource above;
  above.position = {0, 5, 0};
  scene.dropper = softbody::Dropper{.body = above};
  scene.captions = {{2, "second"}, {5, "fifth"}};
  return scene;
}

/// The same a little apart, in empty space without gravity.
inline softbody::Scene without_solids() {
  softbody::Scene scene = touching_pair();
  scene.solids.clear();
  scene.bodies[0].position.x = -0.8;
  scene.bodies[1].position.x = 0.8;
  scene.gravity = glm::dvec3(0.0);
  return scene;
}

/// Returns the mean of the positions of a body's vertices (m).
inline glm::dvec3 centre(const softbody::BodiesInMotion& world, softbody::BodyId id) {
  glm::dvec3 sum(0.0);
  const collide::Frame f = world.positions();
  const collide::Index first = f.bodies->first[id], count = f.bodies->size(id);
  for (collide::Index i = first; i < first + count; ++i) sum += glm::dvec3(f.x[i], f.y[i], f.z[i]) / double(count);
  return sum;
}

/// touching_pair(), but the second body appears later and is not finite.
inline softbody::Scene doomed_pair() {
  softbody::Scene scene = touching_pair();
  scene.bodies[1].velocity.y = std::numeric_limits<double>::quiet_NaN();
  scene.bodies[1].appear = 5;
  return scene;
}

}  // namespace app
