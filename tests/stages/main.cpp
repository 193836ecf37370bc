// bench_stages: what each stage of a frame takes on one thread and on all, beside the least that the machine takes for
// it: in the scene drop-3000, in free fall and in the heap; by surfaces, in the heap of D and of three creatures that
// fall on each other. Each repetition starts from the same recorded worlds.
//
//   bench_stages [REPETITIONS [THREADS]]

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "app/base/table.h"
#include "app/base/timings.h"
#include "softbody/forces/springs.h"
#include "tests/stages/floor.h"
#include "tests/support/world_test_access.h"

namespace {

using app::TableRow;
using softbody::SolverTestAccess;
using softbody::World;
using softbody::WorldTestAccess;

enum Stage {
  pair_setup,
  begin,
  bounds,
  candidates,
  pairs,
  kick,
  rows,
  solve,
  contacts,
  drift,
  wait,
  finish,
  detect,
  whole,
  count
};

/// Of what a stage takes its time.
enum class Per { particle_substep, pair_substep, particle, pair };

/// Bytes that a stage has to read or write at least, with vectors of floats. `roots`: it needs a root and a quotient
/// for each spring.
struct StageKind {
  const char* name;
  Per per;
  int bytes = 0;
  bool roots = false;
};
constexpr int vector = 12;
constexpr int of_pair = 2 * 32 + 2 * 4 + 3 * vector + 3 * 4 + vector + 16;  // particles, numbers, slip and force
constexpr std::array<StageKind, count> kinds{{
    {"pairs set up", Per::pair},
    {"frame begins", Per::particle, 2 * vector},
    {"of which step bounds", Per::particle, 2 * vector},
    {"plans, candidates of surfaces", Per::particle},
    {"pairs", Per::pair_substep, of_pair},
    {"kick, press; drift of the free", Per::particle_substep, 3 * vector, true},
    {"rows of surfaces", Per::pair_substep},
    {"solve of surfaces", Per::pair_substep},
    {"contacts of solids", Per::particle_substep},
    {"drift of the others", Per::particle_substep, 3 * vector},
    {"waiting for threads", Per::particle_substep},
    {"frame ends", Per::particle, 4 * vector},
    {"detection", Per::particle, vector},
    {"whole frame", Per::particle},
}};

using Times = std::array<double, count>;  // ms a frame

/// Adds the time since the last look to a stage.
class StopWatch {
 public:
  void add(Stage stage) {
    const auto now = std::chrono::steady_clock::now();
    times_[stage] += std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
  }
  void skip() { last_ = std::chrono::steady_clock::now(); }
  const Times& times() const { return times_; }

 private:
  Times times_{};
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What one frame of a recorded world is made of. By surfaces, the pairs are the candidates at its end.
struct FrameFacts {
  std::size_t particles = 0, pairs = 0, batch_bytes = 0;
  int substeps = 0;
  bool alone = false;  // most batches take all their substeps at once
  double springs = 0;  // per particle
  std::string integrator;
};

/// Does what ContactPass::apply() does where surfaces may touch.
void meet_surfaces(const SolverTestAccess& s, const softbody::BatchShare& share, float elapsed, float h,
                   StopWatch& watch) {
  softbody::SurfaceContact& surfaces = s.contacts.surfaces();
  const softbody::State& state = s.solver.state();
  const auto x = softbody::field(state.x);
  const auto barrier = [&] { share.barrier(); };
  barrier();
  watch.add(wait);
  surfaces.make_rows(share.thread, s.shares.active(), x, s.solids.velocities_before(), elapsed, h);
  watch.add(rows);
  barrier();
  watch.add(wait);
  surfaces.solve(share.thread, s.shares.active(), x, softbody::field(s.solver.state().v), h, barrier);
  watch.add(solve);
  s.contacts.apply_after_surfaces(share, h);
  watch.add(contacts);
}

/// Does what the integrator does in a substep. elapsed: s, since the frame began.
void take_substep(const SolverTestAccess& s, const softbody::BatchShare& share, float elapsed, float h,
                  StopWatch& watch) {
  const bool implicit = s.solver.steps().plan().integrator->implicit_volume;
  watch.skip();
  for (const softbody::Batch* b : share.batches) s.solids.note_velocities(*b);
  watch.add(contacts);
  if (!s.penalty.pairs().empty()) {
    s.penalty.evaluate(share.part(s.penalty.pairs().size()), {h, softbody::PenaltyContact::max_damped / h});
    watch.add(pairs);
    share.barrier();
    watch.add(wait);
  }
  for (const softbody::Batch* b : share.batches)
    s.motion.advance_velocities(share, *b, h, implicit ? softbody::Volumes::implicit_ : softbody::Volumes::explicit_);
  watch.add(kick);
  if (s.contacts.meets_others(share)) {
    meet_surfaces(s, share, elapsed, h, watch);
  } else {
    implicit ? s.motion.contacts_under_pressure(share, h) : s.motion.contacts(share, h);
    watch.add(contacts);
  }
  for (const softbody::Batch* b : share.batches) s.motion.advance_positions(share, *b, h);
  watch.add(drift);
  share.barrier();
  watch.add(wait);
}

/// Takes substeps as the solver does, `elapsed` seconds after the frame began. Adds the times of each thread.
void take_substeps(SolverTestAccess& s, int substeps, float elapsed, float h, std::vector<StopWatch>& watches) {
  s.motion.begin_substeps(*s.solver.steps().plan().integrator, h);
  s.share_batches();
  std::atomic<std::size_t> next = 0;
  s.shares.run([&](const softbody::BatchShare& share) {
    StopWatch& watch = watches[std::size_t(share.thread)];
    for (int i = 0; i < substeps; ++i) {
      take_substep(s, share, elapsed + float(i) * h, h, watch);
      s.contacts.advance(share, h);
    }
    for (std::size_t b; (b = next++) < s.shares.alone().size();)
      for (int i = 0; i < substeps; ++i)
        take_substep(s, share.alone_with(s.shares.alone()[b]), elapsed + float(i) * h, h, watch);
  });
}

/// Takes a whole frame of the restored world, and then one stage by stage. A stage that threads share takes as long as
/// it takes the slowest.
Times measure(World& world, const softbody::Snapshot& start, FrameFacts& facts) {
  world.restore(start);
  world.step();
  SolverTestAccess s(WorldTestAccess::solver(world));
  const double seconds = world.frame_time();
  std::vector<softbody::BodyId> body;  // of each vertex
  for (softbody::BodyId id = 0; id < world.bodies().count(); ++id) body.insert(body.end(), world.bodies().size(id), id);
  StopWatch watch;
  if (!s.contacts.has_surfaces())
    s.solver.set_contacts({world.bodies(), body, world.detection().contacts, world.collision().tolerance}, seconds);
  watch.add(pair_setup);
  softbody::StepBound bound = s.begin_frame(seconds);
  s.penalty_energy();
  watch.add(begin);
  s.bounds.measure(s.solver.steps().bounds_of());
  watch.add(bounds);
  int substeps = 0;
  std::vector<StopWatch> watches(std::size_t(s.shares.active()));
  for (double left = seconds; left > 1e-9 * seconds;) {
    watch.skip();
    if (substeps > 0) bound = s.bounds.measure(s.solver.steps().bounds_of());
    const auto [taken, h] = s.plan_series(left, bound);
    watch.add(candidates);
    const softbody::Integrator& integrator = *s.solver.steps().plan().integrator;
    if (integrator.key != "imex-euler" && integrator.key != "semi-implicit-euler")
      throw std::runtime_error(fmt::format("auto takes {}, whose stages are not known here", integrator.key));
    take_substeps(s, taken, float(seconds - left), float(h), watches);
    substeps += taken;
    left -= taken * h;
  }
  std::vector<float> places(3 * world.bodies().vertex_count());
  watch.skip();
  s.penalty_energy();
  s.solids.end_frame();
  const std::size_t n = places.size() / 3;
  s.solver.finish_frame(seconds, {places.data(), places.data() + n, places.data() + 2 * n});
  watch.add(finish);

  Times times = watch.times();
  for (const Stage stage : {pairs, kick, rows, solve, contacts, drift, wait})
    for (const StopWatch& of_thread : watches) times[stage] = std::max(times[stage], of_thread.times()[stage]);
  times[detect] = world.last_step().detect_ms;
  times[whole] = world.last_step().total_ms;
  const softbody::Batch& batch = *s.shares.moving().front();
  facts = {.particles = n,
           .pairs = s.contacts.has_surfaces() ? s.contacts.surfaces().candidates().search().features().size()
                                              : s.penalty.pairs().size(),
           .batch_bytes = 2 * vector * batch.values(),
           .substeps = substeps,
           .alone = 2 * s.shares.alone().size() > s.shares.moving().size(),
           .springs = double(softbody::springs<softbody::StructuralSprings>(*batch.model).size() +
                             softbody::springs<softbody::BendSprings>(*batch.model).size()) /
                      double(batch.particles()),
           .integrator = std::string(s.solver.steps().plan().integrator->key)};
  return times;
}

/// A recorded moment, and the times of its repetitions on one thread and on all.
struct Moment {
  const char* name;
  int frame;
  softbody::Snapshot start{};
  FrameFacts facts{};
  std::array<std::array<app::Timings, count>, 2> timings{};
};

void print(const Moment& moment, int threads, double root_and_quotient) {
  const FrameFacts& f = moment.facts;
  const double stream = stages::stream_ns(f.alone ? f.batch_bytes : 2 * vector * f.particles);
  const double roots = f.springs * root_and_quotient;
  app::Table table;
  for (std::size_t i = 0; i < count; ++i) {
    const StageKind& kind = kinds[i];
    const bool of_pairs = kind.per == Per::pair || kind.per == Per::pair_substep;
    const bool of_substeps = kind.per == Per::particle_substep || kind.per == Per::pair_substep;
    const double items = double(of_pairs ? f.pairs : f.particles) * (of_substeps ? f.substeps : 1);
    const double one = moment.timings[0][i].median(), all = moment.timings[1][i].median();
    if (items == 0 || one < 1e-3) continue;  // what takes less than a microsecond is not done
    table.add({{"stage", kind.name},
               {"per", std::string(of_pairs ? "pair" : "particle") + (of_substeps ? " and substep" : "")},
               {"ns", app::brief(1e6 * one / items)},
               {"memory, ns", app::when(kind.bytes > 0, app::brief(stream * kind.bytes))},
               {"divider, ns", app::when(kind.roots, app::brief(roots))},
               {"ms a frame", app::brief(one)},
               {fmt::format("ms, {} threads", threads), app::brief(all)},
               {"gain", app::when(i != wait && all > 0, app::brief(one / all))}});
  }
  fmt::print("{} (frame {}): {} particles, {} pairs, {} substeps of {}\n\n{}\n", moment.name, moment.frame, f.particles,
             f.pairs, f.substeps, f.integrator, table.markdown(2));
}

/// A scene on one thread and on all, and what is recorded of it.
struct Course {
  Course(const softbody::Scene& scene, int threads, std::vector<Moment> list)
      : one(scene, {.threads = 1}), all(scene, {.threads = threads}), moments(std::move(list)) {
    for (Moment& moment : moments) {
      while (all.frame() < moment.frame) all.step();
      moment.start = all.snapshot();
    }
  }
  void repeat() {
    for (Moment& moment : moments)
      for (const bool shared : {false, true}) {
        const Times times = measure(shared ? all : one, moment.start, moment.facts);
        for (std::size_t i = 0; i < count; ++i) moment.timings[shared][i].ms.push_back(times[i]);
      }
  }

  World one, all;
  std::vector<Moment> moments;
};

softbody::Scene heap_of_d() {
  softbody::Scene scene = softbody::find_scene("D", SBCOLLIDE_SCENES);
  scene.contact_surface = softbody::ContactSurface::surfaces;
  return scene;
}

/// Returns the scene of three creatures of 3,000 particles, one above the other, over the ground.
softbody::Scene creatures() {
  softbody::Scene scene = softbody::find_scene("shapes", SBCOLLIDE_SCENES);
  softbody::BodySource creature = scene.dropper->body;
  softbody::MeshFile file = creature.mesh.file;
  file.resolution = 3000;
  creature.mesh = softbody::MeshSource::from_file(file);
  std::erase_if(scene.solids,
                [](const softbody::Solid& s) { return !std::holds_alternative<softbody::Ground>(s.shape); });
  scene.bodies.clear();
  for (const double x : {0.0, 0.1, -0.05}) {
    creature.position = {x, 0.8 + 1.1 * double(scene.bodies.size()), x / 2};
    scene.bodies.push_back(creature);
  }
  return scene;
}

void run(int repetitions, int threads) {
  std::array courses{
      std::make_unique<Course>(
          softbody::find_scene("drop-3000", SBCOLLIDE_SCENES), threads,
          std::vector{Moment{.name = "Free fall", .frame = 10}, Moment{.name = "Heap", .frame = 60}}),
      std::make_unique<Course>(heap_of_d(), threads, std::vector{Moment{.name = "D by surfaces", .frame = 60}}),
      std::make_unique<Course>(creatures(), threads,
                               std::vector{Moment{.name = "Creatures by surfaces, in their worst frame", .frame = 36},
                                           Moment{.name = "Creatures by surfaces", .frame = 60}})};
  collide::Workers lone(1), together(threads);
  app::Timings dividing_alone, dividing;  // ns
  for (int r = 0; r < repetitions; ++r) {
    dividing_alone.ms.push_back(stages::root_and_quotient_ns(lone));
    dividing.ms.push_back(stages::root_and_quotient_ns(together));
    for (const auto& course : courses) course->repeat();
  }
  for (const auto& course : courses)
    for (const Moment& moment : course->moments) print(moment, threads, dividing_alone.median());
  fmt::print("Gain of {} threads that only compute, in registers: {}\n", threads,
             app::brief(dividing_alone.median() / dividing.median()));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int repetitions = argc > 1 ? std::stoi(argv[1]) : 9;
    const int threads = argc > 2 ? std::stoi(argv[2]) : int(std::max(1u, std::thread::hardware_concurrency()));
    if (argc > 3 || repetitions < 1 || threads < 1) throw std::invalid_argument("bench_stages [REPETITIONS [THREADS]]");
    run(repetitions, threads);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_stages: %s\n", error.what());
    return 2;
  }
}
