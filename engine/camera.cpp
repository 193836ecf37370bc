#include "engine/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace engine {
namespace {

constexpr float glide_rate = 14.0f;  // 1/s: what is left to go falls to 1/e in 70 ms

float aspect(glm::ivec2 size) {
  return static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1));
}

glm::vec3 outwards(const Orbit& orbit) {
  const float level = std::cos(orbit.elevation);
  return {level * std::sin(orbit.azimuth), std::sin(orbit.elevation), level * std::cos(orbit.azimuth)};
}

float difference(const Orbit& a, const Orbit& b) {
  return glm::distance(a.target, b.target) / b.distance + std::abs(a.distance / b.distance - 1.0f) +
         std::abs(a.azimuth - b.azimuth) + std::abs(a.elevation - b.elevation);
}

}  // namespace

Orbit Camera::clamped(Orbit orbit) const {
  orbit.distance = std::clamp(orbit.distance, 0.02f * scene_radius_, 20.0f * scene_radius_);
  orbit.elevation = std::clamp(orbit.elevation, -max_elevation, max_elevation);
  const float reach = 10.0f * scene_radius_;
  orbit.target = glm::clamp(orbit.target, centre_ - reach, centre_ + reach);
  if (floor_) {
    const float rise = (*floor_ + 0.02f * scene_radius_ - orbit.target.y) / orbit.distance;  // at least
    orbit.elevation =
        std::clamp(orbit.elevation, std::min(std::asin(std::clamp(rise, -1.0f, 1.0f)), max_elevation), max_elevation);
  }
  return orbit;
}

void Camera::set_orbit(const Orbit& orbit) { now_ = goal_ = clamped(orbit); }

Orbit Camera::fitted(const glm::vec3& centre, float radius, glm::ivec2 size) {
  scene_radius_ = std::max(radius, 1e-4f);
  centre_ = centre;
  return before(centre, scene_radius_, size);
}

/// Where a sphere just fills the viewport.
Orbit Camera::before(const glm::vec3& centre, float radius, glm::ivec2 size) const {
  const float half = std::atan(std::tan(0.5f * fov) * std::min(1.0f, aspect(size)));
  Orbit orbit = goal_;
  orbit.target = centre;
  orbit.distance = radius / std::sin(half);
  return clamped(orbit);
}

void Camera::glide_to(const glm::vec3& centre, float radius, glm::ivec2 size) {
  goal_ = before(centre, 2.0f * radius, size);
}

void Camera::fit(const glm::vec3& centre, float radius, glm::ivec2 size) {
  now_ = goal_ = fitted(centre, radius, size);
}

void Camera::glide_to_fit(const glm::vec3& centre, float radius, glm::ivec2 size) {
  goal_ = fitted(centre, radius, size);
}

void Camera::rotate(glm::vec2 pixels, glm::ivec2 size) {
  const float per_pixel = glm::pi<float>() / static_cast<float>(std::max(size.y, 1));
  goal_.azimuth -= per_pixel * pixels.x;
  goal_.elevation += per_pixel * pixels.y;
  goal_ = clamped(goal_);
  // Kept near 0, where floats are fine; both turn by the same whole circle, so nothing is seen of it.
  const float circle = glm::two_pi<float>() * std::round(goal_.azimuth / glm::two_pi<float>());
  goal_.azimuth -= circle;
  now_.azimuth -= circle;
}

void Camera::pan(glm::vec2 pixels, glm::ivec2 size) {
  const float per_pixel = 2.0f * std::tan(0.5f * fov) * goal_.distance / static_cast<float>(std::max(size.y, 1));
  const glm::vec3 back = outwards(goal_);
  const glm::vec3 right(std::cos(goal_.azimuth), 0.0f, -std::sin(goal_.azimuth));
  goal_.target += per_pixel * (pixels.y * glm::cross(back, right) - pixels.x * right);
  goal_ = clamped(goal_);
}

void Camera::zoom(float steps) {
  goal_.distance *= std::pow(0.9f, steps);
  goal_ = clamped(goal_);
}

bool Camera::advance(double seconds) {
  if (difference(now_, goal_) < 2e-4f) {
    settle();
    return false;
  }
  const float part = 1.0f - static_cast<float>(std::exp(-glide_rate * std::max(seconds, 0.0)));
  now_.target += part * (goal_.target - now_.target);
  now_.distance *= std::pow(goal_.distance / now_.distance, part);
  now_.azimuth += part * (goal_.azimuth - now_.azimuth);
  now_.elevation += part * (goal_.elevation - now_.elevation);
  return true;
}

glm::vec3 Camera::eye() const { return now_.target + now_.distance * outwards(now_); }

glm::mat4 Camera::view() const { return glm::lookAt(eye(), now_.target, glm::vec3(0.0f, 1.0f, 0.0f)); }

glm::mat4 Camera::projection(glm::ivec2 size) const {
  // The near plane follows the eye, so that zooming in cuts nothing open; the far one leaves room for the floor.
  const float near = std::max(0.02f * now_.distance, 1e-3f * scene_radius_);
  const float far = now_.distance + glm::distance(now_.target, centre_) + 40.0f * scene_radius_;
  return glm::perspective(fov, aspect(size), near, far);
}

Ray Camera::pick_ray(glm::vec2 pixel, glm::ivec2 size) const {
  const glm::vec2 ndc = 2.0f * pixel / glm::vec2(glm::max(size, 1)) - 1.0f;
  const float tangent = std::tan(0.5f * fov);
  const glm::vec3 in_view(ndc.x * tangent * aspect(size), -ndc.y * tangent, -1.0f);
  return {eye(), glm::normalize(glm::transpose(glm::mat3(view())) * in_view)};
}

std::optional<glm::vec3> Camera::project(const glm::vec3& point, glm::ivec2 size) const {
  const glm::vec4 clip = projection(size) * view() * glm::vec4(point, 1.0f);
  if (clip.w <= 0.0f) return std::nullopt;
  const glm::vec3 ndc = glm::vec3(clip) / clip.w;
  return glm::vec3(0.5f * (1.0f + ndc.x) * static_cast<float>(size.x),
                   0.5f * (1.0f - ndc.y) * static_cast<float>(size.y), 0.5f * (1.0f + ndc.z));
}

}  // namespace engine
