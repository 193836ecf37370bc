// The demo under a restless user: every simulated second one random change, the same ones every time. It must stay
// finite or say that it is not, hold what it has and no more, and do no more work in a frame than it promises.

#include <GL/glew.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <vector>

#include "collide/methods.h"
#include "softbody/measures.h"
#include "tests/soak/actions.h"
#include "tests/soak/resources.h"
#include "tests/temporary_folder.h"

namespace soak {
namespace {

constexpr int frames_a_second = 60;
constexpr int picture_every = 10;  // frames: the scene's picture is most of the time where the CPU draws
constexpr int warm_up_seconds = 60;
constexpr int many_more_bodies = 45;           // with more the scene begins anew, as frames would last too long
constexpr int many_substeps = 20'000;          // in a second: then it ends, and the scene begins anew
constexpr int implicit_substeps = 150;         // that an implicit step counts for
constexpr int candidates_of_substep = 10'000;  // of surface contact: so many make a substep count for one more
constexpr int cut_substeps = 2000;             // that a frame counts for of which only a part is simulated
constexpr std::size_t large_scene = 50'000;    // vertices; gets a sixtieth of the time

// What a frame may cost: in counted work, and where nothing counts it in processor time, far above what frames take.
constexpr int most_substeps = softbody::World::max_substeps;
constexpr std::uint64_t most_pair_tests = 1'000'000'000;  // Session's own bound for the method that drives
constexpr double most_seconds = 20;
constexpr double slow_seconds = 1;  // from where on a frame that is slower than all before is told of

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

class Soak {
 public:
  Soak(const std::filesystem::path& scenes, const std::filesystem::path& folder) : demo_(scenes, folder) {}

  void run(const std::string& scene, int seconds) {
    dice_ = Dice(scene);
    begin(scene);
    if (demo_.session.world().bodies().vertex_count() > large_scene) seconds = (seconds + 59) / 60;
    std::optional<Resources> warm;
    for (int second = 0; second < seconds; ++second) {
      change(scene);
      int substeps = 0;
      for (int i = 0; i < frames_a_second && substeps < many_substeps; ++i) {
        const int before = demo_.session.world().frame();
        frame(i % picture_every == 0);
        const softbody::World& world = demo_.session.world();
        if (world.frame() == before) continue;
        const softbody::Dynamics& dynamics = world.dynamics();
        const auto candidates = int(dynamics.surface_contact().search().features().size());
        const int weight = dynamics.used_integrator().implicit ? implicit_substeps : 1;
        substeps += world.profile().substeps * (weight + candidates / candidates_of_substep);
        if (world.profile().seconds < world.frame_time()) substeps += cut_substeps;
      }
      if (substeps >= many_substeps) {
        ++impatient_;
        begin(scene);
      }
      if (second % warm_up_seconds != warm_up_seconds - 1) continue;
      if (!warm) fill_tables();
      compare(warm, scene);
      say(scene, second + 1);
    }
    if (seconds % warm_up_seconds != 0) say(scene, seconds);
  }

  const std::string& last() const { return last_; }
  int explosions() const { return explosions_; }
  int explosions_by_itself() const { return explosions_by_itself_; }
  int impatient() const { return impatient_; }

 private:
  void say(const std::string& scene, int seconds) const {
    std::printf("%-10s %4d s, %llu frames so far: at most %d substeps, %llu pair tests, %.2f s of processor time; %s\n",
                scene.c_str(), seconds, static_cast<unsigned long long>(frames_), substeps_,
                static_cast<unsigned long long>(pair_tests_), slowest_, describe(resources()).c_str());
    std::fflush(stdout);
  }

  /// What to look into.
  void say_slow(double seconds) const {
    const softbody::World& world = demo_.session.world();
    const softbody::Profile& p = world.profile();
    const softbody::SurfaceContact& surface = world.dynamics().surface_contact();
    std::printf(
        "%-10s frame %llu: %.2f s of processor time after \"%s\"; %u bodies, %u vertices, %d substeps of %s, %.5f s "
        "simulated, %.0f ms to detect, %.0f ms to solve, with surface contact of %.3g a search and %.3g a substep\n",
        world.scene().key.c_str(), static_cast<unsigned long long>(frames_), seconds, last_.c_str(),
        world.bodies().count(), world.bodies().vertex_count(), p.substeps,
        std::string(world.dynamics().used_integrator().key).c_str(), p.seconds, p.detect_ms, p.solve_ms,
        double(surface.search().work()), surface.work_of_substep(float(p.seconds / std::max(p.substeps, 1))));
    std::fflush(stdout);
  }

  void begin(const std::string& scene) {
    demo_.session.choose_scene(scene);
    if (demo_.session.world().scene().key != scene) fail("the scene cannot be loaded: " + demo_.session.notice());
    count_bodies();
    demo_.session.paused = false;
    demo_.restart_camera();
  }

  void count_bodies() { bodies_ = demo_.session.world().bodies().count(); }

  void change(const std::string& scene) {
    const Action& action = actions()[dice_.pick(actions().size())];
    last_ = std::string(action.name);
    demo_.input.buttons = {};
    demo_.input.wheel = 0;
    const std::string before = demo_.session.world().scene().key;
    action.act(demo_, dice_);
    if (demo_.session.world().scene().key != before) count_bodies();
    const bool elsewhere = demo_.session.world().scene().key != scene;
    const bool many = demo_.session.world().bodies().count() > bodies_ + many_more_bodies;
    if (many || dice_.pick(elsewhere ? 10 : 100) == 0) begin(scene);
    demo_.session.paused = false;
    demo_.ui.quit = false;
  }

  void frame(bool draw) {
    app::Session& session = demo_.session;
    const std::clock_t before = std::clock();
    demo_.frame(draw);
    const double took = double(std::clock() - before) / CLOCKS_PER_SEC;
    ++frames_;
    const softbody::World& world = session.world();
    if (took > std::max(slowest_, slow_seconds)) say_slow(took);
    slowest_ = std::max(slowest_, took);
    substeps_ = std::max(substeps_, world.profile().substeps);
    pair_tests_ = std::max(pair_tests_, world.detection().counters.pair_tests);
    if (substeps_ > most_substeps) fail("a frame took " + std::to_string(substeps_) + " substeps");
    if (pair_tests_ > most_pair_tests) fail("a frame took " + std::to_string(pair_tests_) + " pair tests");
    if (slowest_ > most_seconds) fail("a frame took " + std::to_string(slowest_) + " s of processor time");
    if (const GLenum error = glGetError()) fail("OpenGL error " + std::to_string(error));
    if (session.notice().starts_with(app::Session::defect)) fail(session.notice());
    if (session.stability().blow_up()) return recover();
    if (!softbody::measure(world).finite) fail("not finite, and no blow-up reported");
  }

  /// As the panel offers it. What is chosen too coarse may blow up; what the program chooses by itself may not.
  void recover() {
    app::Session& session = demo_.session;
    const softbody::World& world = session.world();
    ++explosions_;
    const bool by_itself = world.integrator().automatic && !world.substeps();
    if (by_itself) {
      ++explosions_by_itself_;
      std::printf("%-10s frame %llu: %s, after \"%s\"\n", world.scene().key.c_str(),
                  static_cast<unsigned long long>(frames_), session.stability().blow_up()->what.c_str(), last_.c_str());
    }
    if (!session.paused) fail("it blew up and went on");
    if (by_itself && !softbody::measure(world).finite)
      fail("not finite in steps that the program chose: " + session.stability().blow_up()->what);
    session.set_integrator(softbody::default_integrator, std::nullopt);
    session.rewind_to(session.stability().last_good_frame());
    if (!softbody::measure(world).finite) fail("the last good frame is not finite");
    session.paused = false;
  }

  /// Methods keep the largest table that they have had until they build another: so each has it once before memory is
  /// compared.
  void fill_tables() {
    app::Session& session = demo_.session;
    session.compare.on = true;
    for (const collide::Method& method : collide::method_table()) {
      if (!method.uses_hash) continue;
      session.set_method(method.key);
      collide::Settings settings = session.world().collision();
      settings.buckets = collide::max_buckets;
      session.set_collision(settings, false);
      session.paused = false;
      for (int i = 0; i < picture_every; ++i) frame(i == 0);
    }
  }

  /// At the same state each time: the first of the scene.
  void compare(std::optional<Resources>& warm, const std::string& scene) {
    begin(scene);
    const Resources now = resources();
    if (!warm) warm = now;
    if (now.megabytes > 1.2 * warm->megabytes + 32 || now.descriptors > warm->descriptors + 2 ||
        now.gl_objects > warm->gl_objects + 64)
      fail("it grows: " + describe(*warm) + ", then " + describe(now));
  }

  DemoRig demo_;
  Dice dice_{""};
  std::string last_ = "nothing";
  collide::Index bodies_ = 0;  // of the scene as it begins
  int substeps_ = 0, explosions_ = 0, explosions_by_itself_ = 0, impatient_ = 0;
  std::uint64_t frames_ = 0, pair_tests_ = 0;
  double slowest_ = 0;  // s of processor time
};

int run(int seconds, std::vector<std::string> scenes) {
  const std::filesystem::path folder = SBCOLLIDE_SCENES;
  if (scenes.empty()) scenes = softbody::scene_keys(folder);
  const tests::TemporaryFolder out;
  Soak soak(folder, out.path());
  for (const std::string& scene : scenes) {
    try {
      soak.run(scene, seconds);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s, after the change \"%s\": %s\n", scene.c_str(), soak.last().c_str(), error.what());
      return 1;
    }
  }
  std::printf(
      "nothing found; %d times there was more energy or speed than there could be, each time reported as a blow-up, %d "
      "of them "
      "in steps that the program chose; %d seconds ended early, with %d substeps\n",
      soak.explosions(), soak.explosions_by_itself(), soak.impatient(), many_substeps);
  return 0;
}

}  // namespace
}  // namespace soak

int main(int argc, char** argv) {
  int seconds = 0;
  if (argc < 2 || std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), seconds).ec != std::errc{} || seconds < 1) {
    std::fprintf(stderr, "usage: %s SIMULATED_SECONDS [SCENE...]\n", argv[0]);
    return 2;
  }
  return soak::run(seconds, {argv + 2, argv + argc});
}
