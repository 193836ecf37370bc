// The examples of detectors of one's own: compiled as a user compiles them, and called as the program calls a guest.

#include <dlfcn.h>

#include <gtest/gtest.h>
#include <sbcollide/method.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/temporary_folder.h"

namespace api::test {
namespace THIS_FILE {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

struct Cloud {
  std::vector<float> x, y, z;

  Cloud(unsigned seed, std::size_t count, float width, float from) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> within(from, from + width);
    for (std::size_t i = 0; i < count; ++i)
      for (std::vector<float>* axis : {&x, &y, &z}) axis->push_back(within(random));
  }
  bool near(std::size_t a, std::size_t b, float tolerance) const {
    const float dx = x[a] - x[b], dy = y[a] - y[b], dz = z[a] - z[b];
    return dx * dx + dy * dy + dz * dz < tolerance * tolerance;
  }
  Pairs pairs(float tolerance) const {
    Pairs all;
    for (std::uint32_t a = 0; a < x.size(); ++a)
      for (std::uint32_t b = a + 1; b < x.size(); ++b)
        if (near(a, b, tolerance)) all.insert({a, b});
    return all;
  }
};

/// Has room for two pairs at a time.
struct Collector : sbcollide_pairs {
  Collector()
      : sbcollide_pairs{room, room + 4, [](sbcollide_pairs* pairs) { static_cast<Collector*>(pairs)->empty(); }} {}
  void empty() {
    for (const std::uint32_t* at = room; at != next; at += 2) found.insert(std::minmax(at[0], at[1]));
    next = room;
  }
  std::uint32_t room[4]{};
  Pairs found;
};

class Guest {
 public:
  explicit Guest(const std::string& example) {
    const std::string source = SBCOLLIDE_GUESTS "/" + example, library = folder_.path() / "guest.so";
    const std::string flags = " -O0 -Wall -Wextra -pedantic -Werror -fPIC -I " SBCOLLIDE_API " ";
    EXPECT_EQ(std::system(("cc -std=c99 -shared" + flags + source + " -o " + library + " -lm").c_str()), 0);
    EXPECT_EQ(std::system(("c++ -std=c++20 -fsyntax-only -x c++" + flags + source).c_str()), 0) << "C++ takes it, too";
    handle_ = ::dlopen(library.c_str(), RTLD_NOW);
    if (!handle_) throw std::runtime_error(::dlerror());
    method = reinterpret_cast<decltype(&sbcollide_guest)>(::dlsym(handle_, "sbcollide_guest"))();
    self_ = method->make ? method->make() : nullptr;
  }
  Guest(const Guest&) = delete;
  Guest& operator=(const Guest&) = delete;
  ~Guest() {
    if (method->destroy) method->destroy(self_);
    ::dlclose(handle_);
  }

  Pairs find(const Cloud& cloud, float tolerance) {
    const std::uint32_t first[] = {0, std::uint32_t(cloud.x.size())};
    const sbcollide_frame frame{.vertex_count = first[1],
                                .body_count = 1,
                                .edge_count = 0,
                                .triangle_count = 0,
                                .x = cloud.x.data(),
                                .y = cloud.y.data(),
                                .z = cloud.z.data(),
                                .first_vertex = first,
                                .edges = nullptr,
                                .triangles = nullptr};
    Collector pairs;
    method->find(self_, &frame, tolerance, &pairs);
    pairs.empty();
    return pairs.found;
  }

  const sbcollide_method* method;

 private:
  tests::TemporaryFolder folder_;
  void* handle_ = nullptr;
  void* self_ = nullptr;
};

// The second frame has more vertices, and cells beside the origin; in the last one a float is not exact to 1e-5 m.
const std::vector<Cloud> clouds{{1, 200, 1, 3}, {2, 900, 2, -1}, {3, 0, 1, 0}, {4, 500, 0.5f, 100}};
constexpr float tolerance = 0.13f;

TEST(GuestExamples, FindAllPairsIfTheyAreRight) {
  for (const char* example : {"double_loop.c", "hash_grid.c"}) {
    Guest guest(example);
    EXPECT_EQ(guest.method->version, std::uint32_t(SBCOLLIDE_METHOD_VERSION));
    for (const Cloud& cloud : clouds) EXPECT_EQ(guest.find(cloud, tolerance), cloud.pairs(tolerance)) << example;
  }
}

TEST(GuestExamples, MissSomePairsByTheMistake) {
  Guest guest("one_cell.c");
  for (const Cloud& cloud : clouds) {
    const Pairs found = guest.find(cloud, tolerance), all = cloud.pairs(tolerance);
    EXPECT_TRUE(std::ranges::includes(all, found)) << "none is false";
    EXPECT_EQ(found.size() < all.size(), !cloud.x.empty());
  }
}

}  // namespace THIS_FILE
}  // namespace api::test
