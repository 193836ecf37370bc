#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "tests/api/expect_error.h"
#include "tests/api/recorded_bodies.h"

namespace api::test {
namespace THIS_FILE {

using sbcollide::Contact;
using sbcollide::ContactFinder;
using sbcollide::Error;

constexpr std::array<std::array<sbcollide::Index, 3>, 1> corner{{{0, 1, 2}}};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::vector<Contact> copy(std::span<const Contact> contacts) { return {contacts.begin(), contacts.end()}; }

TEST(ContactFinder, FindsWhatTheDetectorsFind) {
  for (const auto& [scene, frame] : {std::pair("D", 90), std::pair("cloth", 120), std::pair("star", 120)}) {
    const RecordedBodies recorded(scene, frame);
    constexpr float tolerance = 0.1f;
    std::vector<float> interleaved;
    for (std::size_t v = 0; v < recorded.x.size(); ++v)
      interleaved.insert(interleaved.end(), {recorded.x[v], recorded.y[v], recorded.z[v]});
    for (const std::string& method : sbcollide::method_keys()) {
      ContactFinder finder({.method = method, .tolerance = tolerance});
      recorded.add_to(finder);
      const std::vector<Contact> expected = recorded.contacts(method, tolerance);
      EXPECT_FALSE(expected.empty()) << scene;
      EXPECT_EQ(copy(finder.find(recorded.x, recorded.y, recorded.z).contacts), expected) << scene << ' ' << method;
      EXPECT_EQ(copy(finder.find(interleaved).contacts), expected) << scene << ' ' << method;
    }
  }
}

TEST(ContactFinder, WorksOnSeveralThreadsEachOnOneOfThem) {
  const RecordedBodies recorded("D", 90);
  std::vector<std::vector<Contact>> found(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < found.size(); ++t)
      threads.emplace_back([&, t] {
        ContactFinder finder(
            {.method = t % 2 == 0 ? "multi-level-sb-exact" : "brute-force", .threads = int(1 + t % 3)});
        recorded.add_to(finder);
        for (int repetition = 0; repetition < 3; ++repetition)
          found[t] = copy(finder.find(recorded.x, recorded.y, recorded.z).contacts);
      });
  }
  EXPECT_FALSE(found[0].empty());
  for (const auto& contacts : found) EXPECT_EQ(contacts, found[0]);
}

TEST(ContactFinder, NamesBodiesThatAreNotFinite) {
  ContactFinder finder;
  for (int body = 0; body < 3; ++body) finder.add_body({.vertices = 1});
  const std::vector<float> x{0, nan, 0.05f}, zero(3);
  const sbcollide::Detection found = finder.find(x, zero, zero);
  EXPECT_EQ(copy(found.contacts), (std::vector<Contact>{{0, 2}}));
  ASSERT_EQ(found.non_finite_bodies.size(), 1u);
  EXPECT_EQ(found.non_finite_bodies[0], 1u);
  EXPECT_EQ(finder.body_of(2), 2u);
}

TEST(ContactFinder, LeavesOutPairsThatSidesJoinOrRestHoldsTogether) {
  const std::vector<float> x{0, 0.01f, 0, 0.01f}, zero(4);
  ContactFinder finder;
  finder.add_body({.vertices = 4, .triangles = corner});
  EXPECT_EQ(copy(finder.find(x, zero, zero).contacts), (std::vector<Contact>{{0, 3}, {1, 3}, {2, 3}}));
  finder.clear_bodies();
  const std::vector<float> rest{0, 0, 0, 1, 0, 0, 2, 0, 0, 2.01f, 0, 0};
  finder.add_body({.vertices = 4, .triangles = corner, .rest = rest});
  EXPECT_EQ(copy(finder.find(x, zero, zero).contacts), (std::vector<Contact>{{0, 3}, {1, 3}}));
  finder.configure({.self_collision = false});
  EXPECT_TRUE(finder.find(x, zero, zero).contacts.empty());
}

TEST(ContactFinder, SaysWhatIsWrong) {
  expect_error("tolerance", [] { ContactFinder({.tolerance = -1}); });
  expect_error("tolerance", [] { ContactFinder({.tolerance = nan}); });
  expect_error("threads", [] { ContactFinder({.threads = 257}); });
  expect_error("levels", [] { ContactFinder({.levels = 16}); });
  expect_error("cell", [] { ContactFinder({.cell_size = {1, 0, 1}}); });
  expect_error("use one of: brute-force", [] { ContactFinder({.method = "fast"}); });
  ContactFinder finder;
  expect_error("vertex", [&] { finder.add_body({.vertices = 2, .triangles = corner}); });
  expect_error("rest: 3 numbers", [&] { finder.add_body({.vertices = 2, .rest = std::vector<float>(3)}); });
  EXPECT_EQ(finder.bodies(), 0u);
  finder.add_body({.vertices = 3});
  expect_error("all bodies together", [&] { finder.add_body({.vertices = ~0u}); });
  const std::vector<float> two(2), three(3);
  expect_error("all 3 vertices", [&] { finder.find(three, three, two); });
  expect_error("three for each", [&] { finder.find(three); });
  expect_error("vertex 3", [&] { (void)finder.body_of(3); });
  EXPECT_EQ(finder.find(three, three, three).contacts.size(), 3u);  // it stays usable
}

}  // namespace THIS_FILE
}  // namespace api::test
