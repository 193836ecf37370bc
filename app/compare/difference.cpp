#include "app/compare/difference.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include <fmt/core.h>

#include "app/base/text.h"
#include "softbody/scene/scene_keys.h"

namespace app::compare {
namespace {

using softbody::Key;
using softbody::Scene;
namespace keys = softbody::scene_key;

bool may_differ(const Key& key) {
  return softbody::is_of_detection(key) && &key != &keys::primes && &key != &keys::self_collision;
}

/// Calls visit(key, value in `scene`, value in `other`) for each key that may differ.
void for_each_pair(const Scene& scene, const Scene& other, auto&& visit) {
  softbody::for_each_value(scene, [&]<class Value>(const Key& key, const Value& value) {
    if (!may_differ(key)) return;
    softbody::for_each_value(other, [&]<class Its>(const Key& its_key, const Its& its) {
      if constexpr (std::is_same_v<Value, Its>)
        if (&its_key == &key) visit(key, value, its);
    });
  });
}

// What the values are called.
std::string words(const Key&, const std::string& method) { return collide::find_method(method)->name; }
std::string words(const Key&, int levels) { return fmt::format("level {}", levels); }
std::string words(const Key&, std::uint32_t buckets) { return grouped(buckets) + " buckets"; }
std::string words(const Key&, float tolerance) { return fmt::format("tolerance {:.3g} m", tolerance); }
std::string words(const Key&, const std::optional<glm::vec3>& cell) {
  return cell ? fmt::format("cells of {:.3g} m", std::max({cell->x, cell->y, cell->z})) : "automatic cells";
}
std::string words(const Key&, softbody::ContactSurface surface) {
  return fmt::format("contact {}",
                     std::ranges::find(softbody::contact_surfaces, surface, &softbody::ContactSurfaceInfo::value)->key);
}
std::string words(const Key& key, const auto&) { return std::string(key.own_name()); }

}  // namespace

Difference::Difference(const HowSimulated& first, HowSimulated second)
    : second_(std::move(second)), integrator_(first.integrator != second_.integrator) {
  for_each_pair(first.scene, second_.scene, [this](const Key& key, const auto& one, const auto& other) {
    if (one != other) keys_.push_back(key.name);
  });
}

bool Difference::has(std::string_view key) const { return std::ranges::find(keys_, key) != keys_.end(); }

HowSimulated Difference::applied_to(HowSimulated first) const {
  softbody::for_each_value(second_.scene, [&](const Key& key, const auto& value) {
    if (has(key.name)) softbody::set_value(first.scene, key, value);
  });
  if (integrator_) first.integrator = second_.integrator;
  return first;
}

Scene Difference::shared(Scene scene, const Scene& first) {
  softbody::for_each_value(first, [&scene](const Key& key, const auto& value) {
    if (may_differ(key)) softbody::set_value(scene, key, value);
  });
  return scene;
}

std::string Difference::text(const HowSimulated& world) const {
  std::vector<std::string> texts;
  softbody::for_each_value(world.scene, [&](const Key& key, const auto& value) {
    if (has(key.name)) texts.push_back(words(key, value));
  });
  if (integrator_) {
    texts.emplace_back(world.integrator.integrator().name);
    if (const auto substeps = world.integrator.substeps) texts.back() += fmt::format(", {} substeps", *substeps);
  }
  return texts.empty() ? "the same settings" : joined(texts, ", ");
}

HowSimulated usual_second(const softbody::BodiesInMotion& first, const softbody::IntegratorChoice& integrator) {
  HowSimulated second{first.scene(), integrator};
  if (first.method().key == collide::paper_method) {
    second.scene.method = collide::default_method;
  } else {
    second.scene.method = collide::paper_method;
    second.scene.collision.cell_size = 0.5f * first.automatic_cell_size(second.scene.collision.levels);
  }
  return second;
}

}  // namespace app::compare
