// Guests in their processes: what they find, and that no wrong one leaves anything behind.

#include "app/guest/guest.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <random>
#include <vector>

#include "app/base/usage_error.h"
#include "tests/guest/wrongs.h"
#include "tests/own_process.h"
#include "tests/temporary_folder.h"

namespace app::guest {
namespace THIS_FILE {

using tests::Wrong;

/// Strips of triangles in a cube of 1 m.
struct Heap {
  collide::Bodies bodies;
  std::vector<float> x, y, z;

  Heap(collide::Index strips, collide::Index vertices) {
    std::vector<std::array<collide::Index, 2>> edges;
    std::vector<std::array<collide::Index, 3>> triangles;
    for (collide::Index v = 0; v + 1 < vertices; ++v) edges.push_back({v, v + 1});
    for (collide::Index v = 0; v + 2 < vertices; ++v) triangles.push_back({v, v + 1, v + 2});
    const auto topology = std::make_shared<collide::Topology>(vertices, edges, triangles);
    for (collide::Index b = 0; b < strips; ++b) bodies.add(std::make_shared<collide::Shape>(topology));
    std::mt19937 random(7);
    for (auto* axis : {&x, &y, &z})
      for (collide::Index v = 0; v < bodies.vertex_count(); ++v)
        axis->push_back(static_cast<float>(random() % 1024) / 1024);
  }
  collide::Frame view() const { return {x, y, z, &bodies}; }
};

std::shared_ptr<Guest> loaded(const std::filesystem::path& file) {
  auto guest = std::make_shared<Guest>(file);
  guest->load();
  return guest;
}

collide::Result search(collide::Detector& detector, const Heap& heap, float tolerance, bool self = true) {
  collide::Workers alone(1);
  collide::Result result;
  detector.detect(heap.view(), {.tolerance = tolerance, .self_collision = self}, alone, result);
  return result;
}

/// Returns what the guest is said to have done wrong; empty if it has not.
std::string problem(collide::Detector& detector, Wrong wrong) {
  try {
    search(detector, Heap(2, 50), static_cast<float>(wrong));
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

// A sanitizer catches the signal itself, and has its own heap.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

/// What must not grow.
struct Taken {
  std::size_t handles = 0, mappings = 0;
  bool children = false;
  bool operator==(const Taken&) const = default;
};
Taken taken() {
  Taken now;
  for ([[maybe_unused]] const auto& handle : std::filesystem::directory_iterator("/proc/self/fd")) ++now.handles;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) now.mappings += line.find("memfd:sbcollide") != std::string::npos;
  now.children = ::waitpid(-1, nullptr, WNOHANG) >= 0;
  return now;
}

TEST(GuestDetector, FindsWhatBruteForceFindsByADoubleLoop) {
  const auto guest = loaded(SBCOLLIDE_HOSTILE_GUEST);
  ASSERT_EQ(guest->build()->problem, "");
  const auto detector = make_detector(guest), brute_force = collide::find_method("brute-force")->make();
  for (const auto& [strips, vertices] : {std::pair(2u, 40u), {1u, 3u}, {5u, 30u}})
    for (const bool self : {true, false}) {
      Heap heap(strips, vertices);
      if (strips == 5) heap.y[35] = std::numeric_limits<float>::quiet_NaN();
      const collide::Result found = search(*detector, heap, 0.25f, self);
      const collide::Result truth = search(*brute_force, heap, 0.25f, self);
      EXPECT_EQ(found.contacts, truth.contacts) << strips << ", " << self;
      EXPECT_EQ(found.self_contacts, truth.self_contacts);
      EXPECT_EQ(found.non_finite_bodies, truth.non_finite_bodies);
      EXPECT_TRUE(found.own_ms && *found.own_ms > 0);
    }
}

TEST(GuestDetector, HandsOverMeshesAndKeepsDataFromFrameToFrame) {
  const auto guest = loaded(SBCOLLIDE_HOSTILE_GUEST);
  const auto detector = make_detector(guest);
  const Heap heap(2, 20);
  const auto found = [&] { return search(*detector, heap, static_cast<float>(Wrong::counts)).contacts; };
  const std::vector<collide::Contact> all{{0, 2}, {1, 38}, {2, 36}, {3, 39}};  // no edge, nor {0, 1}, which is one
  EXPECT_EQ(found(), std::vector(all.begin() + 1, all.end()));
  EXPECT_EQ(found(), all);
  detector->forget();
  EXPECT_EQ(found(), std::vector(all.begin() + 1, all.end()));
}

TEST(GuestDetector, SaysWhatAGuestDoesWrongAndKeepsNothingOfIt) {
  const auto guest = loaded(SBCOLLIDE_HOSTILE_GUEST);
  const Taken before = taken();
  for (const auto& [wrong, said] : {std::pair(Wrong::segfault, "ended by signal SIGSEGV (Segmentation fault)"),
                                    {Wrong::abort, "ended by signal SIGABRT (Aborted)"},
                                    {Wrong::exit, "ended itself with status 0"},
                                    {Wrong::endless, "over its time: 2 s"},
                                    {Wrong::fork, "no process can be started"},
                                    {Wrong::too_many_pairs, "over its pairs: more than 134217728 in one frame"},
                                    {Wrong::out_of_range, "hands over vertex 100, but there are only 100"},
                                    {Wrong::writes_frame, "ended by signal SIGSEGV (Segmentation fault)"},
                                    {Wrong::much_memory, "takes more than 4 GiB of memory"},
                                    {Wrong::reads_input, ""},
                                    {Wrong::throws, "no idea"}}) {
    if (sanitized && (wrong == Wrong::segfault || wrong == Wrong::writes_frame || wrong == Wrong::much_memory))
      continue;
    {
      const auto detector = make_detector(guest);
      const std::string text = *said ? std::string("hostile_guest.so: ") + said : "";
      EXPECT_EQ(problem(*detector, wrong), text);
      EXPECT_EQ(problem(*detector, Wrong::none), text) << "until it changes";
    }
    EXPECT_EQ(taken(), before) << said;
  }
}

const std::string source =
    "#include <sbcollide/method.h>\n"
    "static void find(void* self, const sbcollide_frame* f, float h, sbcollide_pairs* p) {\n"
    "  (void)self, (void)f, (void)h;\n"
    "  sbcollide_add(p, 0, PARTNER);\n"
    "}\n"
    "static const sbcollide_method m = {VERSION, \"mine\", \"Mine\", \"One pair.\", 0, find, 0};\n"
    "SBCOLLIDE_GUEST const sbcollide_method* sbcollide_guest(void) { return &m; }\n";
std::string source_with(const std::string& partner, const std::string& version = "SBCOLLIDE_METHOD_VERSION") {
  return "#define PARTNER " + partner + "\n#define VERSION " + version + "\n" + source;
}

TEST(Guest, IsCompiledAnewWhenItsFileChanges) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("mine.c", source_with("7"));
  const auto guest = loaded(file);
  ASSERT_EQ(guest->build()->problem, "");
  EXPECT_EQ(guest->method()->key, "guest:mine");
  EXPECT_FALSE(guest->changed());
  const auto detector = make_detector(guest);
  const auto partner = [&] { return search(*detector, Heap(2, 20), 0.1f).contacts.at(0).b; };
  EXPECT_EQ(partner(), 7u);

  folder.write("mine.c", source_with("unknown"));
  EXPECT_TRUE(guest->changed());
  EXPECT_EQ(partner(), 7u) << "until it is loaded";
  guest->load();
  const std::string problem_text = guest->build()->problem;
  EXPECT_TRUE(problem_text.starts_with("mine.c: does not compile: mine.c:")) << problem_text;
  EXPECT_NE(problem_text.find("error: "), std::string::npos) << problem_text;
  EXPECT_NE(guest->build()->errors.find("sbcollide_add(p, 0, PARTNER);"), std::string::npos) << "all lines";
  EXPECT_EQ(problem(*detector, Wrong::none), guest->build()->problem);

  std::filesystem::remove(file);
  EXPECT_TRUE(guest->changed());
  guest->load();
  EXPECT_EQ(guest->build()->problem, "mine.c: cannot be read");
  EXPECT_FALSE(guest->changed());

  const Taken before = taken();
  folder.write("mine.c", source_with("8"));
  guest->load();
  EXPECT_EQ(partner(), 8u);
  folder.write("mine.c", source_with("9", "3"));
  guest->load();
  EXPECT_EQ(guest->build()->problem.substr(0, 39), "mine.c: a wrong version: it is made for");
  EXPECT_EQ(problem(*detector, Wrong::none), guest->build()->problem);
  EXPECT_EQ(taken(), before);
}

TEST(Guest, RefusesWhatIsNone) {
  EXPECT_THROW(Guest("method.py"), UsageError);
  const tests::TemporaryFolder folder;
  const std::string why = loaded(folder.write("text.so", "no library"))->build()->problem;
  EXPECT_TRUE(why.starts_with("text.so: ")) << why;
  EXPECT_EQ(loaded(folder.path() / "none.cpp")->build()->problem, "none.cpp: cannot be read");
}

void expect_numbers() {
  const auto add = [] { return loaded(SBCOLLIDE_HOSTILE_GUEST)->method(); };
  EXPECT_EQ(add()->key, "guest:hostile");
  const collide::Method* second = add();
  EXPECT_EQ(second->key, "guest:hostile-2");
  EXPECT_EQ(second->name, "Hostile 2");
  EXPECT_FALSE(second->exact || second->can_drive());
  EXPECT_EQ(collide::find_driver(second->key), nullptr);
}

TEST(Guest, GetsANumberIfItsKeyIsTaken) { tests::in_a_process_of_its_own(expect_numbers); }

}  // namespace THIS_FILE
}  // namespace app::guest
