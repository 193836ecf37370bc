#include "engine/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace engine {
namespace THIS_FILE {

constexpr glm::ivec2 size{1280, 720};

Camera scene_camera() {
  Camera camera;
  camera.fit(glm::vec3(0.5f, 1.0f, -0.25f), 3.0f, size);
  return camera;
}

TEST(Camera, PickRayPassesThroughTheProjectedPoint) {
  const Camera camera = scene_camera();
  for (const glm::vec3 point : {glm::vec3(0, 0, 0), glm::vec3(1, 2, 0.5f), glm::vec3(-1.5f, 0.2f, 1)}) {
    const auto pixel = camera.project(point, size);
    ASSERT_TRUE(pixel);
    const Ray ray = camera.pick_ray(glm::vec2(*pixel), size);
    EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-5f);
    EXPECT_LT(glm::length(glm::cross(point - ray.origin, ray.direction)), 1e-4f);
    EXPECT_GT(glm::dot(point - ray.origin, ray.direction), 0.0f);
  }
}

TEST(Camera, TargetIsInTheMiddlePixelRowsGoDownAndNothingIsBehindTheEye) {
  const Camera camera = scene_camera();
  const glm::vec3 target = camera.orbit().target;
  const auto middle = camera.project(target, size);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x, 640.0f, 0.01f);
  EXPECT_NEAR(middle->y, 360.0f, 0.01f);
  EXPECT_LT(camera.project(target + glm::vec3(0, 1, 0), size)->y, 360.0f);
  EXPECT_FALSE(camera.project(2.0f * camera.eye() - target, size));
}

TEST(Camera, RotationStopsBelowThePoles) {
  Camera camera = scene_camera();
  for (int i = 0; i < 100; ++i) camera.rotate(glm::vec2(0, 200), size);
  camera.finish_glide();
  EXPECT_EQ(camera.orbit().elevation, Camera::max_elevation);
  EXPECT_GT(camera.view()[1][1], 0.0f);  // up is still up
  for (int i = 0; i < 200; ++i) camera.rotate(glm::vec2(0, -200), size);
  camera.finish_glide();
  EXPECT_EQ(camera.orbit().elevation, -Camera::max_elevation);
}

TEST(Camera, StaysAboveTheFloor) {
  Camera camera;
  camera.fit({0, 1, 0}, 3, size);
  camera.set_floor(0.0f);
  for (const float distance : {0.5f, 4.0f, 30.0f}) {
    camera.set_orbit({{0, 1, 0}, distance, 0, 0.5f});
    camera.rotate({0, -3000}, size);
    camera.finish_glide();
    EXPECT_GT(camera.eye().y, 0.0f) << distance;
  }
  camera.set_floor({});
  camera.rotate({0, -3000}, size);
  camera.finish_glide();
  EXPECT_LT(camera.eye().y, 0.0f);
}

TEST(Camera, DragToTheRightTurnsTheSceneToTheRight) {
  Camera camera = scene_camera();
  const glm::vec3 front = camera.orbit().target + 0.3f * (camera.eye() - camera.orbit().target);
  const float before = camera.project(front, size)->x;
  camera.rotate(glm::vec2(40, 0), size);
  camera.finish_glide();
  EXPECT_GT(camera.project(front, size)->x, before + 1.0f);
}

TEST(Camera, PanMovesPointsAtTheTargetsDepthWithTheCursor) {
  Camera camera = scene_camera();
  const glm::vec3 point = camera.orbit().target;
  camera.pan(glm::vec2(100, -60), size);
  camera.finish_glide();
  const auto pixel = camera.project(point, size);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 740.0f, 0.1f);
  EXPECT_NEAR(pixel->y, 300.0f, 0.1f);
}

TEST(Camera, ZoomHasLimitsAndStaysFinite) {
  Camera camera = scene_camera();
  camera.zoom(1e6f);
  camera.finish_glide();
  EXPECT_NEAR(camera.orbit().distance, 0.02f * 3.0f, 1e-5f);
  camera.zoom(-1e6f);
  camera.finish_glide();
  EXPECT_NEAR(camera.orbit().distance, 20.0f * 3.0f, 1e-3f);
  EXPECT_TRUE(std::isfinite(camera.projection(size)[2][2]));
}

TEST(Camera, FitShowsTheWholeSphereInAnyViewport) {
  for (const glm::ivec2 shape : {glm::ivec2(1280, 720), glm::ivec2(300, 900), glm::ivec2(1, 1)}) {
    Camera camera;
    camera.fit(glm::vec3(0.0f), 2.0f, shape);
    for (int i = 0; i < 64; ++i) {
      const float angle = 0.0981748f * static_cast<float>(i);
      const glm::mat4 view = camera.view();
      const glm::vec3 right(view[0][0], view[1][0], view[2][0]), up(view[0][1], view[1][1], view[2][1]);
      const auto pixel = camera.project(2.0f * (std::cos(angle) * right + std::sin(angle) * up), shape);
      ASSERT_TRUE(pixel);
      EXPECT_GE(pixel->x, 0.0f);
      EXPECT_LE(pixel->x, static_cast<float>(shape.x));
      EXPECT_GE(pixel->y, 0.0f);
      EXPECT_LE(pixel->y, static_cast<float>(shape.y));
    }
  }
}

/// Where something is in a picture, in parts of the viewport's size.
struct Extent {
  glm::vec2 low{1e9f}, high{-1e9f};
};
Extent extent_of_sphere(const Camera& camera, const glm::vec3& centre, float radius, glm::ivec2 shape) {
  Extent extent;
  for (int i = 0; i < 4000; ++i) {  // points of a spiral all over the sphere
    const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 4000.0f, angle = 2.4f * static_cast<float>(i);
    const glm::vec3 way(std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle));
    const auto pixel = camera.project(centre + radius * way, shape);
    if (!pixel) continue;
    extent.low = glm::min(extent.low, glm::vec2(*pixel) / glm::vec2(shape));
    extent.high = glm::max(extent.high, glm::vec2(*pixel) / glm::vec2(shape));
  }
  return extent;
}

TEST(Camera, GlidesBackJustSoFarThatASphereIsInThePicture) {
  for (const glm::ivec2 shape : {size, glm::ivec2(300, 900)})
    for (const glm::vec3 centre : {glm::vec3(0, 9, 0), glm::vec3(-7, 1, 2), glm::vec3(2, 1, 8)}) {
      Camera camera = scene_camera();
      camera.set_orbit({{0, 1, 0}, 3});
      camera.glide_back_to_show(centre, 0.5f, shape);
      camera.finish_glide();
      EXPECT_EQ(camera.orbit().target, glm::vec3(0, 1, 0));
      EXPECT_EQ(camera.orbit().azimuth, Orbit{}.azimuth);
      const Extent extent = extent_of_sphere(camera, centre, 0.5f, shape);
      const glm::vec2 room = glm::min(extent.low, 1.0f - extent.high);
      EXPECT_NEAR(std::min(room.x, room.y), 0.0f, 0.01f) << centre.x;
    }
}

TEST(Camera, StaysWhereItIsIfTheSphereIsInThePicture) {
  Camera camera = scene_camera();
  const float distance = camera.orbit().distance;
  camera.glide_back_to_show({0.5f, 1.5f, 0}, 0.5f, size);
  camera.finish_glide();
  EXPECT_EQ(camera.orbit().distance, distance);
}

TEST(Camera, GlideEndsAndTheViewThenStaysBitEqual) {
  Camera camera = scene_camera();
  camera.rotate(glm::vec2(300, 50), size);
  camera.zoom(5.0f);
  int frames = 0;
  while (camera.advance(1.0 / 60.0) && frames < 1000) ++frames;
  EXPECT_GT(frames, 3);
  EXPECT_LT(frames, 120);
  const glm::mat4 before = camera.view();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(camera.advance(1.0 / 60.0));
  EXPECT_EQ(camera.view(), before);
}

TEST(Camera, GlideDoesNotDependOnTheFrameRate) {
  Camera fine = scene_camera(), coarse = fine;
  fine.rotate(glm::vec2(200, 0), size);
  coarse.rotate(glm::vec2(200, 0), size);
  for (int i = 0; i < 8; ++i) fine.advance(0.01);
  coarse.advance(0.08);
  EXPECT_NEAR(fine.orbit().azimuth, coarse.orbit().azimuth, 1e-3f);
}

TEST(Camera, GoesOnGlidingWhenItsDistanceIsScaled) {
  Camera camera = scene_camera(), other = camera;
  for (Camera* each : {&camera, &other}) {
    each->glide_to(glm::vec3(1, 0.5f, 0), 0.5f, size);
    each->advance(0.02);
  }
  camera.scale_distance(1.5f);
  EXPECT_FLOAT_EQ(camera.orbit().distance, 1.5f * other.orbit().distance);
  EXPECT_EQ(camera.orbit().target, other.orbit().target);
  camera.finish_glide();
  other.finish_glide();
  EXPECT_FLOAT_EQ(camera.orbit().distance, 1.5f * other.orbit().distance);
  EXPECT_EQ(camera.orbit().target, other.orbit().target);
}

TEST(Camera, GlideToASphereFillsHalfTheViewport) {
  Camera camera = scene_camera();
  const Orbit before = camera.orbit();
  const glm::vec3 centre(1, 0.5f, 0);
  const float radius = 0.5f;
  camera.glide_to(centre, radius, size);
  camera.finish_glide();
  EXPECT_EQ(camera.orbit().azimuth, before.azimuth);
  EXPECT_EQ(camera.orbit().elevation, before.elevation);
  const float half_angle = std::asin(radius / glm::distance(camera.eye(), centre));  // of the sphere
  EXPECT_NEAR(std::sin(half_angle) / std::sin(0.5f * camera.fov), 0.5f, 1e-3f);
  camera.zoom(-100);
  camera.finish_glide();
  EXPECT_GT(camera.orbit().distance, before.distance);  // the limits are still those of the scene
}

TEST(Camera, AzimuthStaysSmallAfterManyTurns) {
  Camera camera = scene_camera();
  for (int i = 0; i < 10000; ++i) {
    camera.rotate(glm::vec2(500, 0), size);
    camera.advance(0.016);
  }
  EXPECT_LT(std::abs(camera.orbit().azimuth), 20.0f);
}

}  // namespace THIS_FILE
}  // namespace engine
