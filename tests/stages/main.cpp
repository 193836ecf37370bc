// bench_stages: what each stage of a frame takes in the scene drop-3000, in free fall and in the heap, on one thread
// and on all, beside the least that the machine takes for it. Each repetition starts from the same recorded worlds.
//
//   bench_stages [REPETITIONS [THREADS]]

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>

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

enum Stage { pair_setup, begin, bounds, pairs, kick, contacts, drift, wait, finish, detect, whole, count };

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
    {"pairs", Per::pair_substep, of_pair},
    {"kick, press; drift of the free", Per::particle_substep, 3 * vector, true},
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

/// What one frame of a recorded world is made of.
struct FrameFacts {
  std::size_t particles = 0, pairs = 0, batch_bytes = 0;
  int substeps = 0;
  bool alone = false;  // most batches take all their substeps at once
  double springs = 0;  // per particle
  std::string integrator;
};

/// Does what the integrator does in a substep.
void take_substep(const SolverTestAccess& s, const softbody::BatchShare& share, float h, StopWatch& watch) {
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
  if (implicit)
    s.motion.contacts_under_pressure(share, h);
  else
    s.motion.contacts(share, h);
  watch.add(contacts);
  for (const softbody::Batch* b : share.batches) s.motion.advance_positions(share, *b, h);
  watch.add(drift);
  share.barrier();
  watch.add(wait);
}

/// Takes the substeps of a frame as the solver does. Returns the times of each thread.
std::vector<StopWatch> take_substeps(SolverTestAccess& s, int substeps, float h) {
  std::vector<StopWatch> watches(std::size_t(s.shares.active()));
  s.motion.begin_substeps(*s.solver.steps().plan().integrator, h);
  s.share_batches();
  std::atomic<std::size_t> next = 0;
  s.shares.run([&](const softbody::BatchShare& share) {
    StopWatch watch;
    for (int i = 0; i < substeps; ++i) take_substep(s, share, h, watch);
    for (std::size_t b; (b = next++) < s.shares.alone().size();)
      for (int i = 0; i < substeps; ++i) take_substep(s, share.alone_with(s.shares.alone()[b]), h, watch);
    watches[std::size_t(share.thread)] = watch;
  });
  return watches;
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
  s.solver.set_contacts({world.bodies(), body, world.detection().contacts, world.collision().tolerance}, seconds);
  watch.add(pair_setup);
  s.begin_frame(seconds);
  s.penalty_energy();
  watch.add(begin);
  const softbody::StepBound bound = s.bounds.measure(s.solver.steps().bounds_of());
  watch.add(bounds);
  const int substeps = s.solver.steps().plan(bound, seconds).substeps;
  const softbody::Integrator& integrator = *s.solver.steps().plan().integrator;
  if (integrator.key != "imex-euler" && integrator.key != "semi-implicit-euler")
    throw std::runtime_error(fmt::format("auto takes {}, whose stages are not known here", integrator.key));
  const std::vector<StopWatch> watches = take_substeps(s, substeps, float(seconds / substeps));
  std::vector<float> places(3 * world.bodies().vertex_count());
  watch.skip();
  s.penalty_energy();
  s.solids.end_frame();
  const std::size_t n = places.size() / 3;
  s.solver.finish_frame(seconds, {places.data(), places.data() + n, places.data() + 2 * n});
  watch.add(finish);

  Times times = watch.times();
  for (const Stage stage : {pairs, kick, contacts, drift, wait})
    for (const StopWatch& of_thread : watches) times[stage] = std::max(times[stage], of_thread.times()[stage]);
  times[detect] = world.last_step().detect_ms;
  times[whole] = world.last_step().total_ms;
  const softbody::Batch& batch = *s.shares.moving().front();
  facts = {.particles = n,
           .pairs = s.penalty.pairs().size(),
           .batch_bytes = 2 * vector * batch.values(),
           .substeps = substeps,
           .alone = 2 * s.shares.alone().size() > s.shares.moving().size(),
           .springs = double(softbody::springs<softbody::StructuralSprings>(*batch.model).size() +
                             softbody::springs<softbody::BendSprings>(*batch.model).size()) /
                      double(batch.particles()),
           .integrator = std::string(integrator.key)};
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
    if (items == 0) continue;
    const double one = moment.timings[0][i].median(), all = moment.timings[1][i].median();
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

void run(int repetitions, int threads) {
  const softbody::Scene scene = softbody::find_scene("drop-3000", SBCOLLIDE_SCENES);
  World one(scene, {.threads = 1}), all(scene, {.threads = threads});
  collide::Workers lone(1), together(threads);
  app::Timings dividing_alone, dividing;  // ns
  std::array<Moment, 2> moments{{{.name = "Free fall", .frame = 10}, {.name = "Heap", .frame = 60}}};
  for (Moment& moment : moments) {
    while (all.frame() < moment.frame) all.step();
    moment.start = all.snapshot();
  }
  for (int r = 0; r < repetitions; ++r) {
    dividing_alone.ms.push_back(stages::root_and_quotient_ns(lone));
    dividing.ms.push_back(stages::root_and_quotient_ns(together));
    for (Moment& moment : moments)
      for (const bool shared : {false, true}) {
        const Times times = measure(shared ? all : one, moment.start, moment.facts);
        for (std::size_t i = 0; i < count; ++i) moment.timings[shared][i].ms.push_back(times[i]);
      }
  }
  for (const Moment& moment : moments) print(moment, threads, dividing_alone.median());
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
