#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/render/overlays.h"
#include "app/render/palette.h"
#include "app/render/scene_view.h"
#include "app/session/session.h"
#include "engine/gl.h"
#include "engine/headless.h"
#include "engine/resources.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

constexpr glm::ivec2 size{240, 160};

class SceneViewTest : public testing::Test {
 protected:
  SceneViewTest() {
    session_.settings.set_method("multi-level-sb");
    session_.simulation.change_scene("Cells", [](softbody::Scene& s) { s.collision.cell_size = glm::vec3(0.3f); });
  }

  std::vector<std::uint8_t> picture(const render::OverlayRequest& request, render::DrawnPositions positions = {}) {
    positions.now = session_.world().positions();
    render::DrawnMeshes at(session_.world());
    at.shown = at.simulated = positions;
    target_.bind();
    const engine::Camera camera = view_.camera(session_.world(), size);
    view_.draw(session_.world(), request, camera, {{0, 0}, size}, 1.0f, at);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return target_.read().rgba;
  }

  engine::HeadlessContext context_;  // first member: the others require it
  engine::Framebuffer target_{size, 0};
  render::SceneView view_{engine::find_folder("shaders")};
  Session session_{touching_pair(), {}, 1};
};

TEST_F(SceneViewTest, DrawsEachOverlay) {
  const std::vector<collide::Contact> missed{{0, 200}};
  render::OverlayRequest request;
  request.debug = &session_.inspector.shown_geometry();
  request.missed = &missed;
  const std::vector<softbody::SurfaceContactPoint> touches{
      {0, 1, {0, 162, 163, 164}, {1, -0.5f, -0.25f, -0.25f}, {0, 1, 0}}};
  const std::vector<compare::SurfaceMark> marks{{0, {0, 0.3f, 0}, false, 1}, {200, {0, 0.1f, 0}, true, 0}};
  request.surface_contacts = touches;
  request.marks = marks;
  const auto plain = picture(request);
  EXPECT_EQ(picture(request), plain);
  for (const render::OverlayRow& row : render::overlay_table) {
    request.shown = {};
    request.shown.*row.shown = true;
    EXPECT_NE(picture(request), plain) << row.key;
  }
}

TEST_F(SceneViewTest, DrawsTheSelectedBucketWithoutOverlays) {
  render::OverlayRequest request;
  const auto plain = picture(request);
  request.debug = &session_.inspector.shown_geometry();
  session_.inspector.select_bucket(request.debug->box_bucket.at(0));
  request.bucket = session_.inspector.bucket();
  EXPECT_NE(picture(request), plain);
}

TEST_F(SceneViewTest, InterpolatesFromEarlierPositions) {
  compare::Positions earlier;
  earlier.copy(session_.world().positions());
  const auto now = picture({});
  EXPECT_EQ(picture({}, {{}, earlier.x, earlier.y, earlier.z, 0.5f}), now);
  for (float& y : earlier.y) y -= 0.5f;
  EXPECT_EQ(picture({}, {{}, earlier.x, earlier.y, earlier.z, 1.0f}), now);
  EXPECT_NE(picture({}, {{}, earlier.x, earlier.y, earlier.z, 0.5f}), now);
}

/// A body and its ghost would otherwise show through each other in patches.
TEST_F(SceneViewTest, DrawsAGhostThatOverlapsItsBodyBehindItAndOneThatLeftItInPlace) {
  const engine::Camera camera = view_.camera(session_.world(), size);
  const glm::vec3 body(-0.51f, 3, 0.03f), to_eye = glm::normalize(camera.eye() - body);
  const auto pixel = camera.project(body, size);
  const auto at_body = [&](const std::vector<std::uint8_t>& rgba) {
    const std::size_t i =
        4 * static_cast<std::size_t>(static_cast<int>(pixel->y) * size.x + static_cast<int>(pixel->x));
    return std::vector(&rgba[i], &rgba[i] + 3);
  };
  render::OverlayRequest request;
  const auto plain = at_body(picture(request));
  request.ghost = &session_.world();
  for (const float nearer : {0.4f, 1.5f}) {
    compare::Positions moved;
    moved.copy(session_.world().positions());
    for (std::size_t i = 0; i < moved.x.size(); ++i) {
      moved.x[i] += nearer * to_eye.x;
      moved.y[i] += nearer * to_eye.y;
      moved.z[i] += nearer * to_eye.z;
    }
    request.ghost_positions = {session_.world().positions(), moved.x, moved.y, moved.z, 0.0f};
    EXPECT_EQ(at_body(picture(request)) == plain, nearer < 1) << nearer;
  }
}

TEST_F(SceneViewTest, LetsNamedBodiesHideOrVeilTheFacesOfBoxes) {
  const glm::vec3 body(-0.51f, 3, 0.03f);
  const engine::Camera camera = view_.camera(session_.world(), size);
  const glm::vec3 behind = body + 1.2f * glm::normalize(body - camera.eye());
  const glm::ivec2 pixel(*camera.project(body, size));
  for (const bool hide : {false, true}) {
    render::Highlight highlight;
    highlight.bodies = {0};
    highlight.opacity = 0.35f;
    highlight.bodies_hide = hide;
    render::OverlayRequest request;
    request.highlight = &highlight;
    const auto without = picture(request);
    highlight.boxes = {
        {.boxes = {{behind - 0.3f, behind + 0.3f, glm::vec4(0, 0, 1, 1)}}, .occluded_alpha = 0, .face_alpha = 0.8f}};
    const auto with = picture(request);
    const auto i = 4 * static_cast<std::ptrdiff_t>(pixel.y * size.x + pixel.x);
    EXPECT_EQ(std::equal(&with[0] + i, &with[0] + i + 3, &without[0] + i), hide);
  }
}

TEST_F(SceneViewTest, OutlinesOpenBodies) {
  const softbody::World world(softbody::find_scene("cloth", engine::find_folder("assets") / "scenes"), {});
  const engine::Camera camera = view_.camera(world, size);
  target_.bind();
  view_.draw(world, {}, camera, {{0, 0}, size}, 1.0f, render::DrawnMeshes(world));
  const engine::Image image = target_.read();
  const auto darkest_red = [&](const glm::vec3& point) {  // of the pixels near it
    const glm::ivec2 pixel(*camera.project(point, size));
    int least = 255;
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) least = std::min<int>(least, image.at(pixel.x + x, pixel.y + y).r);
    return least;
  };
  const glm::vec3 centre(world.scene().bodies[0].position);
  EXPECT_LT(darkest_red(centre + glm::vec3(0, 0, 2.2f)), darkest_red(centre + glm::vec3(0, 0, 1.8f)) - 40);
}

class AddOverlaysTest : public testing::Test {
 protected:
  AddOverlaysTest() {
    for (std::size_t i = 0; i < world_.bodies().vertex_count(); ++i)
      positions_.push_back(render::DrawnPositions{.now = world_.positions()}[i]);
    request_.shown.true_surfaces = true;
    frame_.positions = frame_.normals = positions_;
  }
  void add(const std::vector<compare::SurfaceMark>& marks) {
    request_.marks = marks;
    render::add_overlays({world_, request_, glm::vec3(0, 3, 9), 500, positions_, positions_}, frame_);
  }

  softbody::World world_{touching_pair(), {}};
  std::vector<glm::vec3> positions_;
  render::OverlayRequest request_;
  engine::FrameData frame_;
};

TEST_F(AddOverlaysTest, MarkWhatIsInsideAnotherBodyWithAMargin) {
  add({{7, {0.1f, 0, 0}, false, 1}});
  ASSERT_EQ(frame_.marks.size(), positions_.size());
  EXPECT_EQ(frame_.marks[7], 1.0f);
  int neighbours = 0, others = 0;
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    const float distance = glm::distance(positions_[v], positions_[7]);
    if (v != 7 && frame_.marks[v] > 0) ++(distance < 0.25f ? neighbours : others);
    if (distance > 0.5f) {
      EXPECT_EQ(frame_.marks[v], 0.0f);
    }
  }
  EXPECT_GE(neighbours, 5);
  EXPECT_LT(others, 16);
}

TEST_F(AddOverlaysTest, MarkOnlyTheDeepestVertexOfAPairByALine) {
  add({{7, {0.1f, 0, 0}, false, 1},
       {8, {0.2f, 0, 0}, false, 1},
       {170, {-0.1f, 0, 0}, false, 0},
       {9, {0.3f, 0, 0}, true, 1}});
  std::vector<engine::Line> lines;
  for (const engine::LineSet& set : frame_.lines) lines.insert(lines.end(), set.lines.begin(), set.lines.end());
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].a, positions_[8]);
  EXPECT_EQ(lines[0].b, positions_[8] + glm::vec3(0.2f, 0, 0));
}

TEST_F(AddOverlaysTest, MarkWhatIsHeldAsLongAsItIs) {
  request_.shown = {};
  for (const std::size_t marks : {1u, 0u}) {
    world_.switch_hold(1, 5);
    frame_.points.clear();
    add({});
    ASSERT_EQ(frame_.points.size(), marks);
    if (marks == 1) {
      EXPECT_EQ(frame_.points[0].points[0].position, positions_[world_.bodies().first[1] + 5]);
    }
  }
}

TEST_F(AddOverlaysTest, DrawContactsSmallerThanTheDistanceBetweenVertices) {
  request_.shown = {.contacts = true};
  const auto diameter = [&](float pixels_at_one_metre) {
    frame_.points.clear();
    render::add_overlays({world_, request_, glm::vec3(0, 3, 9), pixels_at_one_metre, positions_, positions_}, frame_);
    const auto drawn = std::ranges::find_if(frame_.points, [](const auto& set) { return !set.points.empty(); });
    EXPECT_EQ(drawn->points.size(), 2 * world_.detection().contacts.size()) << "all at one distance";
    return drawn->diameter;
  };
  const float pixels = static_cast<float>(world_.model(0).mean_edge) / 9;  // of an edge, at one pixel a metre
  EXPECT_EQ(diameter(3.5f / pixels), 3);
  EXPECT_EQ(diameter(0.5f / pixels), 1);
  EXPECT_EQ(diameter(50 / pixels), 5);
}

TEST(Palette, HasDistinctColoursForDozensOfBodies) {
  for (std::uint32_t a = 0; a < 47; ++a) {
    for (std::uint32_t b = a + 1; b < 47; ++b) {
      EXPECT_GT(glm::distance(render::body_colour(a), render::body_colour(b)), 0.03f) << a << " and " << b;
    }
  }
}

TEST(Palette, ShowsSelfContactsOnABodyOfAnyColour) {
  for (std::uint32_t body = 0; body < 200; ++body)
    EXPECT_GT(glm::distance(render::contact_inside_colour, render::body_colour(body)), 0.5f) << body;
}

TEST(Palette, GetsLighterWithTheLoad) {
  const auto lightness = [](const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
  for (int i = 1; i <= 32; ++i) {
    EXPECT_GT(lightness(render::sequential_colour(static_cast<float>(i) / 32)),
              lightness(render::sequential_colour(static_cast<float>(i - 1) / 32)));
  }
}

}  // namespace THIS_FILE
}  // namespace app
