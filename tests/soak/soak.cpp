// The demo under a restless user: one random action in every simulated second, the same actions in every run. The state
// must stay finite or raise an alarm, memory must not grow, and no frame may do more work than its bounds allow.

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
#include "softbody/world/measures.h"
#include "tests/soak/actions.h"
#include "tests/soak/resources.h"
#include "tests/support/world_test_access.h"
#include "tests/temporary_folder.h"

namespace soak {
namespace {

constexpr int frames_a_second = 60;
constexpr int picture_every = 10;  // frames: where the CPU draws, most of the time goes into the scene's picture
constexpr int warm_up_seconds = 60;
constexpr int max_added_bodies = 45;         // with more the scene starts again, as frames would take too long
constexpr double max_second_work = 2e8;      // with more the simulated second ends, and the scene starts again
constexpr std::size_t large_scene = 50'000;  // vertices; such a scene gets a sixtieth of the time

// Bounds of a frame's work; that of processor time is for work that nothing counts, and far above what frames take.
constexpr double max_budgets = 10;  // for what follows a search for contacts before it is looked whether to go on
constexpr std::uint64_t max_pair_tests = 1'000'000'000;  // Session's own bound for the method that drives
constexpr double max_seconds = 20;
constexpr double slow_seconds = 1;  // a slower frame is reported if it is the slowest so far

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

class Soak {
 public:
  Soak(const std::filesystem::path& scenes, const std::filesystem::path& folder) : demo_(scenes, folder) {}

  void run(const std::string& scene, int seconds) {
    dice_ = Dice(scene);
    start(scene);
    if (demo_.session.world().bodies().vertex_count() > large_scene) seconds = (seconds + 59) / 60;
    std::optional<Resources> warm;
    for (int second = 0; second < seconds; ++second) {
      act_at_random(scene);
      double work = 0;
      for (int i = 0; i < frames_a_second && work < max_second_work; ++i) {
        const int before = demo_.session.world().frame();
        frame(i % picture_every == 0);
        if (demo_.session.world().frame() == before) continue;
        work += steps().spent();
        spent_ += steps().spent();
        solve_ms_ += demo_.session.world().last_step().solve_ms;
      }
      if (work >= max_second_work) {
        ++shortened_seconds_;
        start(scene);
      }
      if (second % warm_up_seconds != warm_up_seconds - 1) continue;
      if (!warm) fill_tables();
      compare(warm, scene);
      print_progress(scene, second + 1);
    }
    if (seconds % warm_up_seconds != 0) print_progress(scene, seconds);
  }

  const std::string& last_action() const { return last_action_; }
  void print_summary() const {
    std::printf(
        "nothing found; %d times there was more energy or speed than there could be, each time reported as a blow-up, "
        "%d of them in steps that the program chose; %d seconds ended early, with %.2g units of work\n",
        explosions_, explosions_by_itself_, shortened_seconds_, max_second_work);
  }

 private:
  const softbody::StepController& steps() const {
    return softbody::WorldTestAccess::solver(*demo_.session.simulated()).steps();
  }

  void print_progress(const std::string& scene, int seconds) const {
    std::printf(
        "%-10s %4d s, %llu frames so far: at most %.2g of the budget, %.1f ns a unit of work, %llu pair tests, %.2f s "
        "of processor time; %s\n",
        scene.c_str(), seconds, static_cast<unsigned long long>(frames_), work_, 1e6 * solve_ms_ / spent_,
        static_cast<unsigned long long>(pair_tests_), slowest_, describe(resources()).c_str());
    std::fflush(stdout);
  }

  void start(const std::string& scene) {
    demo_.session.scenes.choose(scene);
    if (demo_.session.world().scene().key != scene)
      fail("the scene cannot be loaded: " + demo_.session.simulation.notice.text());
    count_bodies();
    demo_.session.simulation.clock.paused = false;
    demo_.restart_camera();
  }

  void count_bodies() { bodies_ = demo_.session.world().bodies().count(); }

  void act_at_random(const std::string& scene) {
    const Action& action = actions()[dice_.pick(actions().size())];
    last_action_ = std::string(action.name);
    demo_.input.buttons = {};
    demo_.input.wheel = 0;
    const std::string before = demo_.session.world().scene().key;
    action.act(demo_, dice_);
    if (demo_.session.world().scene().key != before) count_bodies();
    const bool elsewhere = demo_.session.world().scene().key != scene;
    const bool many = demo_.session.world().bodies().count() > bodies_ + max_added_bodies;
    if (many || dice_.pick(elsewhere ? 10 : 100) == 0) start(scene);
    demo_.session.simulation.clock.paused = false;
  }

  void frame(bool draw) {
    app::Session& session = demo_.session;
    const std::clock_t before = std::clock();
    demo_.frame(draw);
    const double took = double(std::clock() - before) / CLOCKS_PER_SEC;
    ++frames_;
    const softbody::World& world = *session.simulated();
    if (took > std::max(slowest_, slow_seconds))
      std::printf("%-10s frame %llu: %.2f s of processor time after \"%s\"\n", world.scene().key.c_str(),
                  static_cast<unsigned long long>(frames_), took, last_action_.c_str());
    slowest_ = std::max(slowest_, took);
    const double budget = softbody::window_budget.of(world.bodies().vertex_count());
    if (!steps().fixed()) work_ = std::max(work_, steps().spent() / budget);
    pair_tests_ = std::max(pair_tests_, world.detection().counters.pair_tests);
    if (work_ > max_budgets) fail("a frame took " + std::to_string(work_) + " times its budget of work");
    if (pair_tests_ > max_pair_tests) fail("a frame took " + std::to_string(pair_tests_) + " pair tests");
    if (slowest_ > max_seconds) fail("a frame took " + std::to_string(slowest_) + " s of processor time");
    if (const GLenum error = glGetError()) fail("OpenGL error " + std::to_string(error));
    if (session.simulation.notice.text().starts_with(app::session::Simulation::defect_prefix))
      fail(session.simulation.notice.text());
    if (session.simulation.stability().blow_up()) return recover();
    if (!softbody::measure(world).finite) fail("not finite, and no blow-up reported");
  }

  /// Rewinds as the panel does. Bodies may explode in substeps that the user fixed, not in those that the program
  /// chose.
  void recover() {
    app::Session& session = demo_.session;
    const softbody::World& world = *session.simulated();
    ++explosions_;
    const bool by_itself = world.integrator_choice().integrator().automatic && !world.integrator_choice().substeps;
    if (by_itself) {
      ++explosions_by_itself_;
      std::printf("%-10s frame %llu: %s, after \"%s\"\n", world.scene().key.c_str(),
                  static_cast<unsigned long long>(frames_), session.simulation.stability().blow_up()->what.c_str(),
                  last_action_.c_str());
    }
    if (!session.simulation.clock.paused) fail("it blew up and went on");
    if (by_itself && !softbody::measure(world).finite)
      fail("not finite in steps that the program chose: " + session.simulation.stability().blow_up()->what);
    session.settings.set_integrator({});
    session.simulation.rewind_to(session.simulation.stability().last_good_frame());
    if (!softbody::measure(world).finite) fail("the last good frame is not finite");
    session.simulation.clock.paused = false;
  }

  /// Lets each method build its largest table once before memory is compared: a method keeps that memory.
  void fill_tables() {
    app::Session& session = demo_.session;
    demo_.ui.lower = app::ui::LowerView::comparison;
    for (const collide::Method& method : collide::method_table()) {
      if (!method.uses_hash) continue;
      session.settings.set_method(method.key);
      collide::Settings settings = session.world().collision();
      settings.buckets = collide::max_buckets;
      session.simulation.change_scene("Settings", [&](softbody::Scene& s) { s.collision = settings; });
      session.simulation.clock.paused = false;
      for (int i = 0; i < picture_every; ++i) frame(i == 0);
    }
  }

  /// Compares the resources in use with those of the first call, always at the scene's first state.
  void compare(std::optional<Resources>& warm, const std::string& scene) {
    start(scene);
    const Resources now = resources();
    if (!warm) warm = now;
    if (now.megabytes > 1.2 * warm->megabytes + 32 || now.descriptors > warm->descriptors + 2 ||
        now.gl_objects > warm->gl_objects + 64)
      fail("it grows: " + describe(*warm) + ", then " + describe(now));
  }

  DemoRig demo_;
  Dice dice_{""};
  std::string last_action_ = "nothing";
  collide::Index bodies_ = 0;        // of the scene at its start
  double work_ = 0;                  // of the frame with most, over its budget
  double spent_ = 0, solve_ms_ = 0;  // units of work; ms that they took
  int explosions_ = 0, explosions_by_itself_ = 0, shortened_seconds_ = 0;
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
      std::fprintf(stderr, "%s, after the change \"%s\": %s\n", scene.c_str(), soak.last_action().c_str(),
                   error.what());
      return 1;
    }
  }
  soak.print_summary();
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
