// Sequences of mesh files: which vertices and edges a frame's bodies have, and what may change from file to file.

#include "app/files/frame_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/base/usage_error.h"
#include "tests/cli/ply_rig.h"
#include "tests/temporary_folder.h"

namespace cli::test {
namespace THIS_FILE {

using app::files::BodiesBy;
using app::files::FrameSequence;
using app::files::SequenceFrame;
using Indices = std::vector<collide::Index>;

class FrameSequenceTest : public testing::Test {
 protected:
  std::filesystem::path obj(const std::string& text) { return write(text, ".obj"); }
  std::filesystem::path write(const std::string& text, const std::string& ending) {
    return folder.write(std::to_string(written++) + ending, text);
  }
  tests::TemporaryFolder folder;
  int written = 0;
};

const std::string one = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string two = one + "o b\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 4 5 6\n";
const std::string three = two + "o c\nv 7 7 7\nv 8 8 8\nv 9 9 9\nv 9 9 9\nf 7 8 9 10\n";

TEST_F(FrameSequenceTest, SharesTheBodiesOfFrames) {
  FrameSequence sequence({obj(two), obj("o\nv 1 1 1\nv 2 2 2\nv 3 3 3\no\nv 4 4 4\nv 5 5 5\nv 6 6 6\n")}, {});
  EXPECT_EQ(sequence.count(), 2u);
  const SequenceFrame first = sequence.read(0), second = sequence.read(1);
  EXPECT_EQ(first.of, sequence.bodies());
  EXPECT_EQ(second.of, sequence.bodies());
  EXPECT_EQ(second.at.x, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(second.of->bodies.shape[0]->topology().joined(0, 1)) << "edges are those of the first file";
  EXPECT_EQ(&second.of->bodies.shape[0]->topology(), &second.of->bodies.shape[1]->topology()) << "copies share them";
  EXPECT_TRUE(collide::is_complete(second.view()));
}

TEST_F(FrameSequenceTest, GrowsByBodiesAtTheEnd) {
  const FrameSequence::Options grows{.may_grow = true};
  FrameSequence sequence({obj(one), obj(three), obj(two), obj(three)}, grows);
  const SequenceFrame a = sequence.read(0), c = sequence.read(1), again = sequence.read(3), b = sequence.read(2);
  EXPECT_EQ(a.of->bodies.count(), 1u);
  EXPECT_EQ(b.of->bodies.count(), 2u);
  EXPECT_EQ(c.of->bodies.first, (Indices{0, 3, 6, 10}));
  EXPECT_EQ(c.of, again.of);
  EXPECT_EQ(c.at.x.size(), 10u);
  EXPECT_EQ(c.of->bodies.shape[0], a.of->bodies.shape[0]);
  EXPECT_EQ(b.of->bodies.shape[1], c.of->bodies.shape[1]) << "known from the frame before";
  EXPECT_FALSE(c.of->bodies.shape[2]->topology().joined(0, 2)) << "a diagonal";

  EXPECT_THROW(FrameSequence({obj(one), obj(three)}, {}).read(1), app::UsageError);
  EXPECT_THROW(FrameSequence({obj(two), obj(one)}, grows).read(1), app::UsageError);
  EXPECT_THROW(FrameSequence({obj(one)}, {.rest = obj(two), .may_grow = true}), app::UsageError);
}

TEST_F(FrameSequenceTest, RefusesAFrameAndReadsOthersAfterIt) {
  FrameSequence sequence({obj(one), obj("v 0 0 0\n"), obj("v nan 0 0\n"), obj(one)}, {});
  EXPECT_THROW(sequence.read(1), app::UsageError);
  EXPECT_THROW(sequence.read(2), app::files::MeshFileError);
  EXPECT_EQ(sequence.read(3).at.x.size(), 3u);
}

TEST_F(FrameSequenceTest, TakesRestShapesInAnyFormat) {
  const auto rest = write(ply({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}), ".ply");
  const FrameSequence sequence({obj(one)}, {.rest = rest});
  ASSERT_EQ(sequence.bodies()->bodies.shape[0]->rest().size(), 3u);
  EXPECT_EQ(sequence.bodies()->bodies.shape[0]->rest()[1], glm::vec3(2, 0, 0));
}

TEST_F(FrameSequenceTest, CutsPolygonsIntoTriangles) {
  const auto file =
      obj("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0.1 0.1 0\no b\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3 4\nf 5 6 7\nf 5 6 5\n");
  FrameSequence sequence({file}, {});
  const SequenceFrame frame = sequence.read(0);
  const auto quad = triangles_of(frame.of->meshes, 0, frame.at);
  ASSERT_EQ(quad.size(), 2u);
  for (const softbody::Triangle& t : quad)
    EXPECT_TRUE(std::ranges::count(t, 1u) == 1 && std::ranges::count(t, 3u) == 1) << "the cut inside a concave polygon";
  EXPECT_EQ(triangles_of(frame.of->meshes, 1, frame.at), (std::vector<softbody::Triangle>{{0, 1, 2}}));
}

}  // namespace THIS_FILE
}  // namespace cli::test
