#include "app/session/body_controls.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "app/files/inputs.h"

namespace app::session {

using softbody::BodyId;
using softbody::Material;
using softbody::World;

namespace {

/// Returns the velocity that carries a body over `way` under gravity: of the two with this speed the one that arrives
/// first, or the one with the smallest speed if this one is too slow. `way` = v t + g t^2 / 2 is solved for t^2.
glm::dvec3 velocity_over(const glm::dvec3& way, double speed, const glm::dvec3& gravity) {
  const double way2 = glm::dot(way, way), gravity2 = glm::dot(gravity, gravity);
  const double b = speed * speed + glm::dot(way, gravity), discriminant = b * b - gravity2 * way2;
  const bool reaches = discriminant >= 0 && b > 0;
  const double time2 = reaches ? 2 * way2 / (b + std::sqrt(discriminant)) : 2 * std::sqrt(way2 / gravity2);
  const double time = std::sqrt(time2);
  const glm::dvec3 velocity = way / time - 0.5 * time * gravity;
  return velocity * std::min(1.0, BodyControls::max_throw_speed / glm::length(velocity));
}

/// Returns the index of such a material, whatever it is called; the size of `all` if there is none.
std::size_t find_material(const std::vector<Material>& all, Material material) {
  const auto same = [&](const Material& other) {
    material.name = other.name;
    return material == other;
  };
  return static_cast<std::size_t>(std::ranges::find_if(all, same) - all.begin());
}

void make_name_new(std::string& name, const std::vector<Material>& all) {
  const std::string stem = name;
  for (int number = 2; std::ranges::count(all, name, &Material::name) > 0; ++number)
    name = stem + " " + std::to_string(number);
}

}  // namespace

bool BodyControls::can_drop() const {
  const softbody::Scene& scene = simulation_.world().scene();
  return scene.dropper || !scene.bodies.empty();
}

void BodyControls::drop(int count) {
  if (!can_drop()) return;
  const std::string bodies = count == 1 ? "a body" : std::to_string(count) + " bodies";
  simulation_.change_bodies("drop of " + bodies, [count](World& world) {
    world.drop(count);
    return true;
  });
}

void BodyControls::throw_body(const glm::dvec3& eye, const glm::dvec3& target) {
  assert(eye != target);
  if (!can_drop()) return;
  std::optional<BodyId> body;
  simulation_.change_bodies("throw of a body", [&](World& world) {
    body = world.throw_body(eye, velocity_over(target - eye, throw_speed, world.scene().gravity));
    if (body) select(body);
    return body.has_value();
  });
  if (!body && !simulation_.notice.is_error())
    simulation_.notice.set("there is no room for a body before the camera: turn or move it");
}

void BodyControls::add(softbody::BodySource body, Material material) {
  try {
    files::protect_input(body.mesh);
  } catch (const std::exception& error) {
    return simulation_.notice.set(error.what());
  }
  simulation_.change_bodies("import of a body", [&](World& world) {
    softbody::Scene scene = world.scene();
    const std::size_t known = find_material(scene.materials, material);
    body.material = static_cast<int>(known);
    if (known == scene.materials.size()) {
      make_name_new(material.name, scene.materials);
      scene.materials.push_back(std::move(material));
      world.apply(scene);
    }
    world.add(body);
    return true;
  });
}

void BodyControls::select(std::optional<BodyId> body) {
  selected_ = body && *body < simulation_.world().bodies().count() ? body : std::nullopt;
  if (selected_) simulation_.notice.clear();
}

void BodyControls::switch_hold(softbody::Index particle) {
  assert(selected_);
  bool holds = false;
  simulation_.change_bodies("hold of a vertex", [&](World& world) {
    holds = world.switch_hold(*selected_, particle);
    return true;
  });
  simulation_.notice.tell(holds ? "Held there. K at the same place lets it go." : "Let go.");
}

void BodyControls::remove_selected() {
  if (!selected_) return simulation_.notice.set("click a body first, then delete it");
  simulation_.change_bodies("deletion of a body", [body = *selected_](World& world) {
    world.grab({});
    world.remove(body);
    return true;
  });
  selected_.reset();
}

}  // namespace app::session
