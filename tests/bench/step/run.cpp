#include "tests/bench/step/run.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>

#include "app/base/timings.h"

namespace bench {
namespace {

/// An entrant on the way through one repetition.
class Runner {
 public:
  Runner(const Entrant& entrant, const softbody::Scene& scene)
      : entrant_(entrant), stepper_(entrant.make(scene, entrant.steps)), judge_(stepper_->state()) {}

  const Entrant& entrant() const { return entrant_; }
  const Times& times() const { return times_; }
  const Figures& figures() const { return judge_.figures(); }

  void frame() {
    if (judge_.figures().lost > 0) return;
    const double cpu = app::thread_seconds();
    const auto wall = std::chrono::steady_clock::now();
    stepper_->step();
    times_.wall.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall).count());
    times_.cpu.push_back((app::thread_seconds() - cpu) * 1e3);
    const double seconds = double(times_.cpu.size()) / frames_a_second;
    if (stepper_->finite())
      judge_.look(stepper_->state(), seconds);
    else
      judge_.not_finite(seconds);
  }

 private:
  const Entrant& entrant_;
  std::unique_ptr<Stepper> stepper_;
  Judge judge_;
  Times times_;
};

/// Nothing random is in the motion: what a frame took longer in one repetition than in another, it was disturbed by.
void take_least(std::vector<double>& least, const std::vector<double>& times) {
  if (least.empty()) least = times;
  if (least.size() != times.size()) throw std::runtime_error("two repetitions went different ways");
  std::ranges::transform(least, times, least.begin(), [](double a, double b) { return std::min(a, b); });
}

}  // namespace

std::vector<Track> run(const Course& course, std::span<const Entrant* const> entrants) {
  const softbody::Scene scene = stiff_pile(*course.gas);
  std::vector<Track> tracks;
  for (const Entrant* entrant : entrants) tracks.push_back({entrant, {}, {}});
  std::mt19937 random;
  for (int repetition = 0; repetition < course.repeat; ++repetition) {
    std::vector<std::unique_ptr<Runner>> runners;
    for (const Entrant* entrant : entrants) runners.push_back(std::make_unique<Runner>(*entrant, scene));
    std::vector<Runner*> order;
    for (const auto& runner : runners) order.push_back(runner.get());
    for (int frame = 0; frame < course.frames; ++frame) {
      std::shuffle(order.begin(), order.end(), random);
      for (Runner* runner : order) runner->frame();
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      take_least(tracks[i].times.cpu, runners[i]->times().cpu);
      take_least(tracks[i].times.wall, runners[i]->times().wall);
      tracks[i].figures = runners[i]->figures();
    }
  }
  return tracks;
}

}  // namespace bench
