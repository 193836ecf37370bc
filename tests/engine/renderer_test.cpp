#include "engine/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "engine/gl.h"
#include "engine/resources.h"
#include "tests/engine/drawing_context.h"
#include "tests/engine/shapes.h"

namespace engine {
namespace THIS_FILE {

constexpr glm::ivec2 size{320, 240};
const glm::vec3 middle(0.0f, 1.0f, 0.0f);
const Sphere red_sphere{middle, 0.5f, glm::vec3(0.9f, 0.2f, 0.2f)};

/// Draws a frame with a floor, seen from above.
class RendererTest : public testing::Test {
 protected:
  RendererTest() {
    frame.floor_height = 0.0f;
    frame.bounds_centre = glm::vec3(0.0f, 0.5f, 0.0f);
    frame.bounds_radius = 3.0f;
    camera.set_orbit({glm::vec3(0.0f, 0.5f, 0.0f), 5.0f, 0.0f, 0.6f});
  }

  Image picture(int samples = 0, glm::ivec2 picture_size = size) {
    const Framebuffer framebuffer(picture_size, samples);
    framebuffer.bind();
    renderer.draw(camera, {glm::ivec2(0), picture_size}, frame);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return framebuffer.read();
  }

  /// Adds the vertices of a red icosahedron to the frame; returns how to draw it.
  MeshDraw body(const glm::vec3& at, float radius) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& p : icosahedron().positions) {
      positions.push_back(at + radius * p);
      normals.push_back(p);
    }
    frame.positions = positions;
    frame.normals = normals;
    return {mesh, first, 12, red_sphere.colour};
  }

  glm::ivec3 colour(const Image& image, const glm::vec3& point) const {
    const auto pixel = camera.project(point, {image.width, image.height});
    return glm::ivec3(image.at(static_cast<int>(pixel->x), static_cast<int>(pixel->y)));
  }

  static bool red(const glm::ivec3& c) { return c.r > c.g + 60 && c.r > c.b + 60; }
  static int brightness(const glm::ivec3& c) { return (c.r + c.g + c.b) / 3; }

  DrawingContext context;
  render::Renderer renderer{find_folder("shaders")};
  MeshHandle mesh = renderer.add_mesh(icosahedron().triangles, 12);
  Camera camera;
  FrameData frame;
  std::vector<glm::vec3> positions, normals;
};

TEST_F(RendererTest, EmptyFrameShowsABrightBackdrop) {
  frame.floor_height.reset();
  const Image image = picture();
  const auto [min, max] = std::ranges::minmax(image.rgba);
  EXPECT_GT(min, 140);
  EXPECT_LE(max, 255);
}

TEST_F(RendererTest, DrawsASphereAtItsPlaceTheSameTwice) {
  frame.spheres = {red_sphere};
  for (const int samples : {0, 4}) {
    const Image image = picture(samples);
    EXPECT_EQ(picture(samples).rgba, image.rgba);
    const glm::vec3 right(0.45f, 0.0f, 0.0f), beyond(0.6f, 0.0f, 0.0f);
    EXPECT_TRUE(red(colour(image, middle)));
    EXPECT_TRUE(red(colour(image, middle + right)));
    EXPECT_TRUE(red(colour(image, middle - right)));
    EXPECT_FALSE(red(colour(image, middle + beyond)));
    EXPECT_FALSE(red(colour(image, middle - beyond)));
  }
}

TEST_F(RendererTest, DrawsACapsuleAtItsPlace) {
  const glm::vec3 half(0.8f, 0.3f, 0.0f);
  frame.capsules = {{middle - half, middle + half, 0.25f, red_sphere.colour}};
  const Image image = picture();
  const glm::vec3 along = glm::normalize(half), across(-along.y, along.x, 0.0f);
  for (const float at : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f}) {
    EXPECT_TRUE(red(colour(image, middle + at * half + 0.2f * across))) << at;
    EXPECT_TRUE(red(colour(image, middle + at * half - 0.2f * across))) << at;
    EXPECT_FALSE(red(colour(image, middle + at * half + 0.33f * across))) << at;
  }
  EXPECT_TRUE(red(colour(image, middle + half + 0.2f * along))) << "its ends are round";
  EXPECT_FALSE(red(colour(image, middle + half + 0.33f * along)));
}

/// A cube on its edge.
OrientedBox red_box() {
  const glm::vec3 x(0.36f, 0.36f, 0.0f), y(-0.36f, 0.36f, 0.0f), z(0.0f, 0.0f, 0.5f);
  return {middle, glm::mat3(x, y, z), red_sphere.colour};
}

TEST_F(RendererTest, DrawsAnOrientedBoxAtItsPlaceWithAShadow) {
  const Image empty = picture();
  frame.oriented_boxes = {red_box()};
  const Image image = picture();
  const glm::vec3 front(0.0f, 0.0f, 0.5f), right(0.65f, 0.0f, 0.0f), up(0.0f, 0.65f, 0.0f);
  for (const glm::vec3& corner : {right, -right, up, -up}) EXPECT_TRUE(red(colour(image, middle + front + corner)));
  EXPECT_FALSE(red(colour(image, middle + front + 0.7f * (right - up)))) << "it stands on its edge";
  const glm::vec3 shadow(0.7f, 0.0f, -0.42f);
  EXPECT_LT(brightness(colour(image, shadow)), brightness(colour(empty, shadow)) - 30);
}

TEST_F(RendererTest, DrawsOnlyTheFrontOfAPlane) {
  frame.floor_height.reset();
  frame.spheres = {red_sphere};
  for (const float side : {-1.0f, 1.0f}) {  // before or behind the sphere, facing the camera
    frame.planes = {{middle + glm::vec3(0.0f, 0.0f, 0.7f * side), glm::vec3(0.0f, 0.0f, 1.0f)}};
    EXPECT_EQ(red(colour(picture(), middle)), side < 0.0f);
  }
  frame.planes[0].normal = {0.0f, 0.0f, -1.0f};
  EXPECT_TRUE(red(colour(picture(), middle))) << "its back is invisible";
}

TEST_F(RendererTest, SphereCastsAShadowAwayFromTheLight) {
  const Image empty = picture();
  frame.spheres = {red_sphere};
  const Image image = picture();
  // The light comes from (-0.40, 1, 0.42). The sphere's centre is 1 m above the floor, so its shadow is centred 0.40 m
  // to the right and 0.42 m behind.
  const glm::vec3 shadow(0.40f, 0.0f, -0.42f), opposite(-0.9f, 0.0f, 0.9f);
  EXPECT_LT(brightness(colour(image, shadow + glm::vec3(0.3f, 0.0f, 0.0f))),
            brightness(colour(empty, shadow + glm::vec3(0.3f, 0.0f, 0.0f))) - 30);
  EXPECT_NEAR(brightness(colour(image, opposite)), brightness(colour(empty, opposite)), 12);
}

TEST_F(RendererTest, LitFloorShowsNoShadowAcne) {
  const Image empty = picture();
  // The colour of the lit floor varies slowly; only the thin grid lines differ a little.
  for (int y = size.y / 2; y < size.y; ++y) {
    for (int x = 1; x < size.x; ++x) EXPECT_LT(std::abs(empty.at(x, y).r - empty.at(x - 1, y).r), 20);
  }
}

TEST_F(RendererTest, DrawsABodyInItsColourAtItsVertices) {
  for (const std::size_t before : {5, 2043, 4084, 4096}) {  // vertices of other bodies; a row holds 2,048
    positions.assign(before, glm::vec3(9.0f));
    normals.assign(before, glm::vec3(0, 1, 0));
    frame.meshes = {body(middle, 0.5f)};
    for (const bool tessellated : {false, true}) {
      frame.tessellated = tessellated;
      const Image image = picture();
      EXPECT_TRUE(red(colour(image, middle))) << before;
      EXPECT_FALSE(red(colour(image, middle + glm::vec3(0.6f, 0, 0)))) << before;
    }
  }
}

TEST_F(RendererTest, TessellatedBodyFillsTheSphereBetterThanFlatTriangles) {
  frame.meshes = {body(glm::vec3(0.0f), 1.0f)};
  const auto covered = [&](bool tessellated) {
    frame.tessellated = tessellated;
    const Image image = picture();
    int count = 0;
    for (int i = 0; i < size.x * size.y; ++i) count += red(glm::ivec3(image.at(i % size.x, i / size.x)));
    return count;
  };
  EXPECT_GT(covered(true), covered(false) * 105 / 100);
}

TEST_F(RendererTest, LinesAndPointsAreFaintBehindASphere) {
  const glm::vec4 blue(0.0f, 0.0f, 1.0f, 1.0f);
  const auto blueness = [&](const glm::vec3& point) {
    const glm::ivec3 c = colour(picture(), point);
    return c.b - c.r;
  };
  for (const bool as_point : {false, true}) {
    const glm::vec3 place(0.0f, 1.2f, 0.0f);
    const auto show = [&](float occluded_alpha) {
      frame.lines.clear();
      frame.points.clear();
      if (as_point) {
        frame.points = {{{{place, blue}}, 8.0f, occluded_alpha}};
      } else {
        frame.lines = {{{{place - glm::vec3(1, 0, 0), place + glm::vec3(1, 0, 0), blue}}, 4.0f, occluded_alpha}};
      }
      return blueness(place);
    };
    frame.spheres.clear();
    EXPECT_GT(show(0.2f), 150);
    frame.spheres = {red_sphere};
    const int hidden = show(0.0f), faint = show(0.3f);
    EXPECT_LT(hidden, 0);
    EXPECT_GT(faint, hidden + 20);
    EXPECT_LT(faint, 100);
  }
}

TEST_F(RendererTest, ManyPointsInOnePlaceAreAsFaintAsOneBehindASphere) {
  frame.spheres = {red_sphere};
  const Point point{middle, glm::vec4(0, 0, 1, 1)};
  const auto with = [&](std::vector<Point> points) {
    frame.points = {{std::move(points), 12.0f, 0.3f}};
    return colour(picture(), middle);
  };
  EXPECT_NE(with({point}), with({}));
  EXPECT_EQ(with({point, point, point}), with({point}));
}

TEST_F(RendererTest, LineThroughTheEyeIsClipped) {
  frame.floor_height.reset();
  const glm::vec3 eye = camera.eye();
  frame.lines = {{{{middle, eye + 2.0f * (eye - middle), glm::vec4(0, 0, 1, 1)}}, 4.0f, 0.0f}};
  const Image image = picture();
  int blue = 0;
  for (int i = 0; i < size.x * size.y; ++i) {
    const auto c = image.at(i % size.x, i / size.x);
    blue += c.b > 200 && c.r < 50;
  }
  EXPECT_GT(blue, 4);
  EXPECT_LT(blue, size.x * size.y / 4);
}

TEST_F(RendererTest, DrawsABoxWithEdgesAndFaintFaces) {
  const Image empty = picture();
  frame.boxes = {{{{glm::vec3(-0.5f, 0.5f, -0.5f), glm::vec3(0.5f, 1.5f, 0.5f), glm::vec4(0, 0, 1, 1)}}, 3.0f}};
  const Image image = picture();
  const glm::ivec3 edge = colour(image, {0.0f, 1.5f, 0.5f}), face = colour(image, {0.1f, 1.0f, 0.5f});
  EXPECT_GT(edge.b - edge.r, 120);
  EXPECT_GT(face.b - face.r, 5);
  EXPECT_LT(face.b - face.r, 80);
}

TEST_F(RendererTest, DrawsAtAnySizeDownToOnePixel) {
  frame.spheres = {red_sphere};
  for (const glm::ivec2 any : {glm::ivec2(1, 1), glm::ivec2(3, 500), glm::ivec2(640, 480)}) {
    for (const int samples : {0, 4}) {
      const Image image = picture(samples, any);
      EXPECT_EQ(image.width, any.x);
      EXPECT_EQ(image.at(0, 0).a, 255);
    }
  }
  renderer.draw(camera, {glm::ivec2(0), glm::ivec2(0)}, frame);  // a minimised window
}

TEST_F(RendererTest, DrawsOnlyIntoTheViewport) {
  const Framebuffer framebuffer(size, 0);
  framebuffer.bind();
  glClearColor(0.0f, 1.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  renderer.draw(camera, {{100, 50}, {120, 90}}, frame);
  const Image image = framebuffer.read();
  EXPECT_EQ(image.at(99, 120), glm::u8vec4(0, 255, 0, 255));
  EXPECT_EQ(image.at(160, 240 - 50), glm::u8vec4(0, 255, 0, 255));
  EXPECT_NE(image.at(160, 120), glm::u8vec4(0, 255, 0, 255));
}

TEST_F(RendererTest, RefusesDrawsThatDoNotFit) {
  frame.meshes = {body(middle, 0.5f)};
  EXPECT_NO_THROW(picture());
  frame.meshes = {{{1}, 0, 12}};
  EXPECT_THROW(picture(), std::invalid_argument);  // no such mesh
  frame.meshes = {{mesh, 1, 12}};
  EXPECT_THROW(picture(), std::invalid_argument);  // beyond the last vertex
  frame.meshes.clear();
  frame.marks = {1.0f};
  EXPECT_THROW(picture(), std::invalid_argument);  // fewer marks than positions
  frame.marks.clear();
  frame.normals = {};
  EXPECT_THROW(picture(), std::invalid_argument);
  EXPECT_THROW(renderer.add_mesh(icosahedron().triangles, 11), std::invalid_argument);
}

TEST_F(RendererTest, TranslucentBodiesShowWhatIsBehindThemAndCastNoShadow) {
  const Image empty = picture();
  const MeshDraw draw = body(middle, 0.5f);
  const auto redness = [&](const Image& image) {
    const glm::ivec3 c = colour(image, middle);
    return 2 * c.r - c.g - c.b;
  };
  int before = redness(empty);
  for (const float opacity : {0.2f, 0.5f, 1.0f}) {
    frame.translucent = {{{draw}, opacity}};
    const Image image = picture();
    EXPECT_GT(redness(image), before + 20) << opacity;
    before = redness(image);
    int differing = 0;  // beside the body nothing changes, so it casts no shadow
    for (int x = 0; x < size.x; ++x) differing += image.at(x, size.y - 20) != empty.at(x, size.y - 20);
    EXPECT_EQ(differing, 0);
  }
}

/// Two bodies, one behind the other.
class TranslucentTest : public RendererTest {
 protected:
  TranslucentTest() {
    camera.set_orbit({middle, 5.0f, 0.0f, 0.0f});
    back.colour = {0.1f, 0.1f, 0.9f};
  }
  glm::ivec3 centre() { return colour(picture(), middle + glm::vec3(0, 0, 0.5f)); }

  MeshDraw front = body(middle + glm::vec3(0, 0, 0.5f), 0.4f), back = body(middle - glm::vec3(0, 0, 0.5f), 0.4f);
};

TEST_F(TranslucentTest, ShowsOnlyTheNearestSurfaceOfASet) {
  for (const bool hides : {false, true}) {
    frame.translucent = {{{front}, 0.4f, hides}};
    const glm::ivec3 alone = centre();
    frame.translucent = {{{back, front}, 0.4f, hides}};
    EXPECT_EQ(centre(), alone);
  }
}

TEST_F(TranslucentTest, HidesOrVeilsWhatIsBehind) {
  const auto blue = [&](bool hides) {
    frame.translucent = {{{front}, 0.4f, hides}};
    const glm::ivec3 c = centre();
    return c.b - c.g;
  };
  const int hiding = blue(true), veiling = blue(false);
  EXPECT_EQ(hiding, veiling);
  frame.points = {{{{middle, glm::vec4(0, 0, 1, 1)}}, 12.0f, 0.0f}};
  EXPECT_EQ(blue(true), hiding);
  EXPECT_GT(blue(false), veiling + 60);
}

TEST_F(TranslucentTest, StandsBehindBodiesButNotBehindOtherSolids) {
  frame.meshes = {back};
  const glm::ivec3 without = centre();
  frame.translucent = {{.meshes = {front}, .opacity = 0.4f, .behind_bodies = true}};
  EXPECT_EQ(centre(), without);
  frame.translucent[0].behind_bodies = false;
  EXPECT_NE(centre(), without);
  frame.spheres = {{middle, 0.3f, glm::vec3(0.6f)}};  // before the body, behind the other one
  frame.translucent.clear();
  const glm::ivec3 sphere = centre();
  frame.translucent = {{.meshes = {front}, .opacity = 0.4f, .behind_bodies = true}};
  EXPECT_GT(centre().r - centre().g, sphere.r - sphere.g + 20);
}

TEST_F(TranslucentTest, StandsBehindBodiesOfAnEarlierSet) {
  frame.translucent = {{.meshes = {back}, .opacity = 0.4f}};
  const glm::ivec3 without = centre();
  frame.translucent.push_back({.meshes = {front}, .opacity = 0.4f, .hides = false, .behind_bodies = true});
  EXPECT_EQ(centre(), without);
  frame.translucent[1].behind_bodies = false;
  EXPECT_NE(centre(), without);
}

TEST_F(TranslucentTest, MarksRegionsOfSolidBodies) {
  frame.meshes = {front};
  const auto darkest = [&](const glm::vec3& around) {
    const Image image = picture();
    const auto pixel = camera.project(around, size);
    int least = 255;
    for (int x = -8; x <= 8; ++x)  // over a stripe
      least =
          std::min(least, brightness(glm::ivec3(image.at(static_cast<int>(pixel->x) + x, static_cast<int>(pixel->y)))));
    return least;
  };
  const glm::vec3 left = middle + glm::vec3(-0.2f, 0, 0.5f), right = middle + glm::vec3(0.2f, 0, 0.5f);
  const int plain_left = darkest(left), plain_right = darkest(right);
  for (const glm::vec3& p : frame.positions) frame.marks.push_back(p.x < -0.1f ? 1.0f : 0.0f);
  EXPECT_LT(darkest(left), plain_left - 40);
  EXPECT_EQ(darkest(right), plain_right);
}

TEST_F(RendererTest, DrawsEdgesThatBoxesShareOnce) {
  const Box box{middle - 0.5f, middle + 0.5f, glm::vec4(0, 0, 1, 0.5f)};
  const auto with = [&](std::vector<Box> boxes) {
    frame.boxes = {{std::move(boxes), 2.0f, 0.2f, 0.0f}};
    return picture().rgba;
  };
  EXPECT_EQ(with({box, box, box}), with({box}));
  const Box right{box.lo + glm::vec3(1, 0, 0), box.hi + glm::vec3(1, 0, 0), box.colour};
  EXPECT_NE(with({box, right}), with({box}));
}

}  // namespace THIS_FILE
}  // namespace engine
