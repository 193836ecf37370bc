#include "app/report/detection/results.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "app/base/usage_error.h"
#include "app/files/frame_sequence.h"
#include "app/report/files.h"
#include "softbody/world/world.h"

namespace app::report {
namespace {

constexpr std::uint64_t large_scene = 50'000;  // vertices

MeasuredState copy(const softbody::World& world) {
  MeasuredState state{{}, world.frame()};
  state.copy(world.positions());
  return state;
}

}  // namespace

SceneResult record(const softbody::Scene& scene, bool quick, int threads) {
  const std::uint64_t vertices = std::max<std::uint64_t>(vertex_count(scene), 1);
  const std::uint64_t steps = quick ? 1'000'000 : 60'000'000;  // of one vertex each
  const auto last = int(std::clamp<std::uint64_t>(steps / vertices, 2, 800));
  const bool large = vertices >= large_scene;
  std::set<int> frames{last};
  if (!quick) frames.insert(std::max(1, last / 8));
  if (!quick && !large) frames.insert(last / 2);
  softbody::World world(scene, {.threads = threads});
  SceneResult recording{scene.key, scene.name, world.collision().buckets, {}, {}};
  std::optional<MeasuredState> busiest;
  std::size_t max_contacts = 0;
  for (const int frame : frames) {
    while (world.frame() < frame) {
      world.step();
      const std::size_t contacts = world.detection().contacts.size();
      if (large || contacts <= max_contacts) continue;
      max_contacts = contacts;
      busiest = copy(world);
    }
    recording.states.push_back(copy(world));
  }
  if (busiest && !frames.contains(busiest->frame)) recording.states.push_back(std::move(*busiest));
  std::ranges::sort(recording.states, {}, &MeasuredState::frame);
  if (recording.states.back().bodies.vertex_count() == 0)
    throw UsageError("scene '" + scene.key + "': no body has arrived by frame " + std::to_string(world.frame()) +
                     ", so there is nothing to measure");
  recording.configurations = compare::sweep_configurations(world);
  return recording;
}

SceneResult record_sequence(const ReportOptions& options) {
  files::FrameSequence sequence({options.files.begin(), options.files.end()}, {.by = options.by, .rest = options.rest});
  collide::Settings settings;
  settings.tolerance = float(*options.tolerance);
  const auto state = [&](std::size_t frame) {
    files::SequenceFrame read = sequence.read(frame);
    return MeasuredState{{{std::move(read.at)}, read.of->bodies}, int(frame)};
  };
  const std::size_t count = sequence.count(), last = count - 1;
  std::size_t busiest = 0, max_contacts = 0;
  const auto detector = collide::find_method(collide::default_method)->make();
  collide::Workers workers(options.cores);
  collide::Result found;
  for (std::size_t frame = 0; frame < count; ++frame) {
    say("looking for the frame with the most contacts", double(frame) / double(count));
    const MeasuredState here = state(frame);
    try {
      detector->detect(here.view(), settings, workers, found);
    } catch (const std::length_error& error) {  // more contacts than a method may report
      throw UsageError(options.files[frame] + ": " + error.what());
    }
    if (found.contacts.size() <= max_contacts) continue;
    max_contacts = found.contacts.size();
    busiest = frame;
  }
  std::set<std::size_t> frames{busiest};
  if (!options.quick) frames.insert(last);
  if (!options.quick && sequence.bodies()->bodies.vertex_count() < large_scene) frames.insert({count / 8, count / 2});

  const std::filesystem::path first = options.files.front();
  SceneResult recording{first.stem().string(), first.filename().string(), settings.buckets, {}, {}};
  if (count > 1) recording.name += " to " + sequence.file(last).filename().string();
  for (const std::size_t frame : frames) recording.states.push_back(state(frame));
  const MeasuredState begin = state(0);
  recording.configurations = compare::sweep_configurations(
      settings, [&](int levels) { return collide::automatic_cell_size(begin.view(), levels, settings.tolerance); });
  return recording;
}

}  // namespace app::report
