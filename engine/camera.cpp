#include "engine/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace engine {
namespace {

constexpr float glide_rate = 14.0f;  // 1/s: the remaining way falls to 1/e in 70 ms

float aspect(glm::ivec2 size) {
  return static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1));
}

/// Returns the direction from the target to the eye, of length 1.
glm::vec3 eye_direction(const Orbit& orbit) {
  const float level = std::cos(orbit.elevation);
  return {level * std::sin(orbit.azimuth), std::sin(orbit.elevation), level * std::cos(orbit.azimuth)};
}

glm::vec3 right_of(const Orbit& orbit) { return {std::cos(orbit.azimuth), 0.0f, -std::sin(orbit.azimuth)}; }

/// Returns the sum of the differences of the angles (radians) and of the relative differences of distance and target.
float difference(const Orbit& a, const Orbit& b) {
  return glm::distance(a.target, b.target) / b.distance + std::abs(a.distance / b.distance - 1.0f) +
         std::abs(a.azimuth - b.azimuth) + std::abs(a.elevation - b.elevation);
}

}  // namespace

Orbit Camera::clamped(Orbit orbit) const {
  orbit.distance = std::clamp(orbit.distance, 0.02f * scene_radius_, 20.0f * scene_radius_);
  orbit.elevation = std::clamp(orbit.elevation, -max_elevation, max_elevation);
  const float max_offset = 10.0f * scene_radius_;
  orbit.target = glm::clamp(orbit.target, scene_centre_ - max_offset, scene_centre_ + max_offset);
  if (floor_) {
    const float min_rise = (*floor_ + 0.02f * scene_radius_ - orbit.target.y) / orbit.distance;
    const float min_elevation = std::min(std::asin(std::clamp(min_rise, -1.0f, 1.0f)), max_elevation);
    orbit.elevation = std::clamp(orbit.elevation, min_elevation, max_elevation);
  }
  return orbit;
}

void Camera::set_orbit(const Orbit& orbit) { current_ = goal_ = clamped(orbit); }

void Camera::scale_distance(float factor) {
  for (Orbit* orbit : {&current_, &goal_}) {
    orbit->distance *= factor;
    *orbit = clamped(*orbit);
  }
}

/// Returns the orbit from which the sphere just fills the viewport.
Orbit Camera::fitting_orbit(const glm::vec3& centre, float radius, glm::ivec2 size) const {
  const float half_angle = std::atan(std::tan(0.5f * fov) * std::min(1.0f, aspect(size)));
  Orbit orbit = goal_;
  orbit.target = centre;
  orbit.distance = radius / std::sin(half_angle);
  return clamped(orbit);
}

void Camera::glide_to(const glm::vec3& centre, float radius, glm::ivec2 size) {
  goal_ = fitting_orbit(centre, 2.0f * radius, size);
}

void Camera::glide_back_to_show(const glm::vec3& centre, float radius, glm::ivec2 size) {
  const glm::vec3 back = eye_direction(goal_), right = right_of(goal_), way = centre - goal_.target;
  // Returns the distance from which the sphere touches a side of the picture, whose half angle has this tangent.
  const auto touching = [&](const glm::vec3& across, float tangent) {
    const float reach = std::abs(glm::dot(way, across)) + radius * std::sqrt(1.0f + tangent * tangent);
    return glm::dot(way, back) + reach / tangent;
  };
  const float tangent = std::tan(0.5f * fov);
  goal_.distance =
      std::max({goal_.distance, touching(right, tangent * aspect(size)), touching(glm::cross(back, right), tangent)});
  goal_ = clamped(goal_);
}

void Camera::fit(const glm::vec3& centre, float radius, glm::ivec2 size) {
  scene_radius_ = std::max(radius, 1e-4f);
  scene_centre_ = centre;
  current_ = goal_ = fitting_orbit(centre, scene_radius_, size);
}

void Camera::rotate(glm::vec2 pixels, glm::ivec2 size) {
  const float per_pixel = glm::pi<float>() / static_cast<float>(std::max(size.y, 1));
  goal_.azimuth -= per_pixel * pixels.x;
  goal_.elevation += per_pixel * pixels.y;
  goal_ = clamped(goal_);
  // Keeps the azimuth near 0, where floats are precise. Both azimuths change by the same number of full circles, which
  // changes no picture.
  const float circles = glm::two_pi<float>() * std::round(goal_.azimuth / glm::two_pi<float>());
  goal_.azimuth -= circles;
  current_.azimuth -= circles;
}

void Camera::pan(glm::vec2 pixels, glm::ivec2 size) {
  const float per_pixel = 2.0f * std::tan(0.5f * fov) * goal_.distance / static_cast<float>(std::max(size.y, 1));
  const glm::vec3 back = eye_direction(goal_), right = right_of(goal_);
  goal_.target += per_pixel * (pixels.y * glm::cross(back, right) - pixels.x * right);
  goal_ = clamped(goal_);
}

void Camera::zoom(float steps) {
  goal_.distance *= std::pow(0.9f, steps);
  goal_ = clamped(goal_);
}

bool Camera::advance(double seconds) {
  if (difference(current_, goal_) < 2e-4f) {
    finish_glide();
    return false;
  }
  const float share = 1.0f - static_cast<float>(std::exp(-glide_rate * std::max(seconds, 0.0)));
  current_.target += share * (goal_.target - current_.target);
  current_.distance *= std::pow(goal_.distance / current_.distance, share);
  current_.azimuth += share * (goal_.azimuth - current_.azimuth);
  current_.elevation += share * (goal_.elevation - current_.elevation);
  return true;
}

glm::vec3 Camera::eye() const { return current_.target + current_.distance * eye_direction(current_); }

glm::mat4 Camera::view() const { return glm::lookAt(eye(), current_.target, glm::vec3(0.0f, 1.0f, 0.0f)); }

glm::mat4 Camera::projection(glm::ivec2 size) const {
  // Zooming in brings the near plane closer to the eye, so that it cuts no body open. The far plane is behind the
  // visible floor.
  const float near = std::max(0.02f * current_.distance, 1e-3f * scene_radius_);
  const float far = current_.distance + glm::distance(current_.target, scene_centre_) + 40.0f * scene_radius_;
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
