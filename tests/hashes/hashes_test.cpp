// The state that every shipped scene comes to by either contact, one of them by every integrator, bit for bit: through
// the program, by one thread with the best instructions; by two threads with others, over a snapshot; and in
// test_hashes_scalar, where Eigen is compiled without vectors. Where other bits are meant from now on,
//   test_hashes --write
// writes hashes.txt anew. Its first line is the version of meshoptimizer: coarse meshes depend on it.

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "softbody/mechanics/bound.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"
#include "tests/cli/process.h"
#include "tests/every_target.h"

namespace softbody::test {
namespace {

struct Row {
  std::string scene, surface, integrator;
  int frames = 0;
  std::string hash;        // 16 hexadecimal digits, as `simulate --json` prints them
  std::size_t number = 0;  // in the file
};

struct Golden {
  int meshoptimizer = 0;
  std::vector<Row> rows;
};

Golden read_golden() {
  Golden golden;
  std::ifstream file(SBCOLLIDE_HASHES);
  std::string name;
  file >> name >> golden.meshoptimizer;
  for (Row r; file >> r.scene >> r.surface >> r.integrator >> r.frames >> r.hash; ++r.number) golden.rows.push_back(r);
  return golden;
}

/// Returns the targets but the widest, which Highway numbers lowest: all of them for an integrator that one row has,
/// and by turns one for the rows of `auto`.
std::vector<std::int64_t> targets_of(const Row& row) {
  std::vector<std::int64_t> all = tests::targets();
  if (all.size() > 1) all.erase(all.begin());
  return row.integrator == "auto" ? std::vector{all[row.number % all.size()]} : all;
}

void run(World& world, int frames) {
  while (world.frame() < frames) world.step();
}

/// By two threads, and from half the way on in a new world.
std::string hash_of(const Row& row, std::int64_t target) {
  const tests::UseTarget use(target);
  Scene scene = find_scene(row.scene, SBCOLLIDE_SCENES);
  scene.contact_surface = find_contact_surface(row.surface)->value;
  World::Options options;
  options.integrator.key = row.integrator;
  options.threads = 2;
  options.least_share = 0;
  World world(scene, options);
  run(world, row.frames / 2);
  World fresh(scene, options);
  fresh.restore(world.snapshot());
  run(fresh, row.frames);
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << fresh.state_hash();
  return text.str();
}

/// Returns the hash of the file; if the scene has coarse meshes of another version, of a run.
std::string expected_hash(const Row& row) {
  const auto is_coarse = [](const BodySource& body) { return body.mesh.imported && body.mesh.imported->coarse; };
  const bool other_meshes = read_golden().meshoptimizer != MESHOPTIMIZER_VERSION &&
                            std::ranges::any_of(find_scene(row.scene, SBCOLLIDE_SCENES).bodies, is_coarse);
  return other_meshes ? hash_of(row, targets_of(row)[0]) : row.hash;
}

class Hashes : public testing::TestWithParam<Row> {};

TEST_P(Hashes, AreEqualHoweverTheSceneIsRun) {
  const std::string expected = expected_hash(GetParam());
  for (const std::int64_t target : targets_of(GetParam()))
    EXPECT_EQ(hash_of(GetParam(), target), expected) << hwy::TargetName(target);
}

TEST_P(Hashes, AreThoseOfTheProgram) {
  const cli::test::Outcome outcome = cli::test::run(
      {"simulate", "--json", "--scene", GetParam().scene, "--contact-surface", GetParam().surface, "--integrator",
       GetParam().integrator, "--frames", std::to_string(GetParam().frames), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["state_hash"], expected_hash(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(All, Hashes, testing::ValuesIn(read_golden().rows), [](const auto& one) {
  std::string name =
      one.param.scene + "_" + one.param.surface + "_" + one.param.integrator + "_" + std::to_string(one.param.frames);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// It decides how many substeps there are.
TEST(PairBound, IsTheSameBits) {
  constexpr Index particles = 1000;
  std::vector<WeightedPair> pairs;
  for (Index i = 0; i < particles; ++i)
    for (const Index reach : {1u, 7u, 60u}) pairs.push_back({i, (i + reach) % particles, 1 + 1.0 / (i + reach)});
  const double found = pair_bound(particles, pairs);
  EXPECT_EQ(found, 0x1.8ad2588498a01p+3) << std::hexfloat << found;
}

TEST(HashFile, HasEveryShippedSceneByEitherContact) {
  for (const std::string& key : scene_keys(SBCOLLIDE_SCENES))
    for (const ContactSurfaceInfo& surface : contact_surfaces)
      EXPECT_TRUE(std::ranges::any_of(
          read_golden().rows,
          [&](const Row& r) { return r.scene == key && r.surface == surface.key && r.integrator == "auto"; }))
          << key << ", " << surface.key;
}

int write_rows() {
  std::vector<Row> rows = read_golden().rows;
  for (Row& row : rows) row.hash = hash_of(row, targets_of(row)[0]);
  std::ofstream file(SBCOLLIDE_HASHES);
  file << "meshoptimizer " << MESHOPTIMIZER_VERSION << '\n';
  for (const Row& r : rows)
    file << r.scene << ' ' << r.surface << ' ' << r.integrator << ' ' << r.frames << ' ' << r.hash << '\n';
  return file ? 0 : 1;
}

}  // namespace
}  // namespace softbody::test

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  if (count == 2 && std::string(arguments[1]) == "--write") return softbody::test::write_rows();
  return RUN_ALL_TESTS();
}
