#include "tests/bench/timing.h"

#include <algorithm>
#include <random>

#include <fmt/core.h>
#include <time.h>

#include "collide/methods.h"
#include "tests/bench/median.h"

namespace bench {
namespace {

/// Milliseconds: on one thread of the processor's time, which other processes do not add to; else of the clock.
double now(int threads) {
  timespec time;
  clock_gettime(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

collide::Settings settings_of(const Course& course) {
  collide::Settings settings;
  settings.tolerance = float(double(course.tolerance) * course.state->unit);
  // For grid-hash, whose one good choice this is: small cells, and about twice as many buckets as vertices.
  settings.cell_size = glm::vec3(std::max(settings.tolerance, float(course.state->edge)));
  settings.buckets = std::min(collide::max_buckets, 2 * course.state->bodies.vertex_count() + 1);
  return settings;
}

/// A candidate in one course. Keeps its detector, and with it its memory, from round to round.
class Runner {
 public:
  Runner(const Candidate& candidate, const Course& course, collide::Workers& workers)
      : candidate_(&candidate), course_(course), workers_(workers), detector_(candidate.make()) {}

  const Candidate& candidate() const { return *candidate_; }

  /// Detects frame k and returns the milliseconds that it took.
  double run(std::size_t k) {
    const collide::Frame frame = course_.state->frame(k);
    const double start = now(course_.threads);
    if (candidate_->forgets || k == 0) detector_->forget();
    detector_->detect(frame, settings_, workers_, result_);
    return now(course_.threads) - start;
  }
  const std::vector<collide::Contact>& contacts() const { return result_.contacts; }

  std::vector<double> times;

 private:
  const Candidate* candidate_;
  const Course& course_;
  collide::Workers& workers_;
  std::unique_ptr<collide::Detector> detector_;
  collide::Settings settings_ = settings_of(course_);
  collide::Result result_;
};

const Candidate& reference(const State& state) {
  constexpr collide::Index brute_force_limit = 20'000;  // vertices
  static const Candidate brute_force{collide::reference_method, "", true, collide::find_method("brute-force")->make};
  static const Candidate grid_hash{"grid-hash", "", true, collide::find_method("grid-hash")->make};
  return state.bodies.vertex_count() <= brute_force_limit ? brute_force : grid_hash;
}

void compare(const Runner& runner, const Runner& truth, const Course& course, std::size_t k) {
  const auto &found = runner.contacts(), &wanted = truth.contacts();
  if (found == wanted) return;
  const auto [f, w] = std::mismatch(found.begin(), found.end(), wanted.begin(), wanted.end());
  const bool extra = w == wanted.end() || (f != found.end() && *f < *w);
  const collide::Contact at = extra ? *f : *w;
  throw Difference(
      fmt::format("{}: state {}, frame {}, tolerance {:f} {}: {} contacts where {} finds {}; first {}: {}, {}",
                  runner.candidate().key, course.state->key, k, course.tolerance, course.state->unit_name, found.size(),
                  truth.candidate().key, wanted.size(), extra ? "too many" : "missing", at.a, at.b));
}

}  // namespace

Measured measure(const Course& course, std::span<const Candidate> candidates) {
  collide::Workers workers(course.threads);
  const std::size_t frames = course.state->frames.size();
  std::vector<Runner> runners;
  for (const Candidate& c : candidates) runners.emplace_back(c, course, workers);

  Measured measured{.course = course, .contacts = 0, .rows = {}};
  Runner truth(reference(*course.state), course, workers);
  for (std::size_t k = 0; k < frames; ++k) {
    truth.run(k);
    if (k == 0) measured.contacts = truth.contacts().size();
    for (Runner& runner : runners) {
      runner.run(k);
      compare(runner, truth, course, k);
    }
  }

  std::mt19937 random;
  std::vector<Runner*> order;
  for (Runner& runner : runners) order.push_back(&runner);
  for (int round = 0; round < course.repeat; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    for (Runner* runner : order) {
      runner->run(0);
      double ms = 0;
      for (std::size_t k = 1; k < frames; ++k) ms += runner->run(k);
      runner->times.push_back(ms / double(frames - 1));
    }
  }
  for (Runner& r : runners)
    measured.rows.push_back({&r.candidate(), median(r.times), *std::min_element(r.times.begin(), r.times.end())});
  return measured;
}

}  // namespace bench
