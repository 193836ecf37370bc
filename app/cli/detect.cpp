#include "app/cli/detect.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <iterator>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/base/timings.h"
#include "app/files/contacts_csv.h"
#include "app/files/frame_sequence.h"

namespace app::cli {
namespace {

// All frames stay in memory, so that the times do not include reading.
constexpr std::size_t max_positions = std::size_t{1} << 27;  // of all frames together: 1.5 GiB

/// The content of the files, which are consecutive frames of the same bodies.
struct Sequence {
  std::vector<files::SequenceFrame> frames;
  std::vector<std::string> notes;

  const files::BodyMeshes& meshes() const { return frames.front().of->meshes; }
  const collide::Bodies& bodies() const { return frames.front().of->bodies; }
};

Sequence read_sequence(const DetectOptions& options) {
  files::FrameSequence files({options.files.begin(), options.files.end()}, {.by = options.by, .rest = options.rest});
  const std::size_t vertices = files.bodies()->bodies.vertex_count();
  if (vertices * files.count() > max_positions)
    throw UsageError(std::to_string(files.count()) + " files of " + std::to_string(vertices) +
                     " vertices each: at most " + std::to_string(max_positions) +
                     " together; give fewer files at a time");
  Sequence sequence;
  for (std::size_t f = 0; f < files.count(); ++f) sequence.frames.push_back(files.read(f));
  sequence.notes = files.notes();
  return sequence;
}

/// The figures of one frame.
struct DetectRow {
  std::size_t contacts = 0;
  std::uint64_t self_contacts = 0;
  collide::Counters counters;
  collide::Skipped skipped{};
  Timings times;  // by repetition
};

/// Returns the time (ms) from positions in memory to the finished list of contacts.
double timed_detect(collide::Detector& detector, const collide::Frame& frame, const collide::Settings& settings,
                    collide::Workers& workers, collide::Result& result, const std::string& file) {
  try {
    return time_ms([&] { detector.detect(frame, settings, workers, result); });
  } catch (const std::length_error& error) {  // more contacts than a method may report
    throw UsageError(file + ": " + error.what());
  }
}

std::vector<DetectRow> run(const Options& options, const collide::Method& method, const collide::Settings& settings,
                           const Sequence& sequence) {
  std::optional<files::ContactsCsv> csv;
  if (options.detect.contacts) csv.emplace(*options.detect.contacts);
  collide::Workers workers(options.threads);
  collide::Result result;
  std::vector<DetectRow> rows(sequence.frames.size());
  for (int repetition = 0; repetition < options.detect.repeat; ++repetition) {
    auto detector = method.make();
    for (std::size_t f = 0; f < rows.size(); ++f) {
      if (!options.detect.reuse) detector->forget();
      const collide::Frame frame = sequence.frames[f].view();
      rows[f].times.ms.push_back(timed_detect(*detector, frame, settings, workers, result, options.detect.files[f]));
      if (repetition > 0) continue;
      rows[f].contacts = result.contacts.size();
      rows[f].self_contacts = result.self_contacts;
      rows[f].counters = result.counters;
      rows[f].skipped = result.skipped;
      if (csv)
        csv->add(f, frame, sequence.meshes().file_vertex,
                 result.contacts);  // now, because the lists of all frames may be too large to keep
    }
  }
  if (csv) csv->commit();
  return rows;
}

void print_json(const Options& options, const collide::Method& method, const std::vector<std::string>& notes,
                const collide::Bodies& bodies, const std::vector<DetectRow>& rows) {
  using Json = nlohmann::ordered_json;
  Json frames = Json::array();
  for (const DetectRow& r : rows) {
    Json skipped = Json::object();
    for (std::size_t kind = 0; kind < r.skipped.size(); ++kind)
      skipped[std::string(collide::skip_kinds[kind].key)] = r.skipped[kind];
    frames.push_back({{"frame", frames.size()},
                      {"contacts", r.contacts},
                      {"self_contacts", r.self_contacts},
                      {"ms", {{"min", r.times.min()}, {"median", r.times.median()}}},
                      {"pair_tests", r.counters.pair_tests},
                      {"hashes", r.counters.hashes},
                      {"boxes", r.counters.boxes},
                      {"skipped", skipped}});
  }
  const Json document{
      {"method", method.key},     {"tolerance", *options.detection.tolerance}, {"threads", options.threads},
      {"bodies", bodies.count()}, {"vertices", bodies.vertex_count()},         {"warnings", notes},
      {"frames", frames}};
  std::cout << document.dump() << '\n';
}

void print_table(const Options& options, const collide::Method& method, const std::vector<std::string>& notes,
                 const collide::Bodies& bodies, const std::vector<DetectRow>& rows) {
  std::cout << fmt::format("{}, tolerance {:g} m, threads {}, bodies {}, vertices {}\n", method.name,
                           *options.detection.tolerance, options.threads, bodies.count(), bodies.vertex_count());
  for (const std::string& note : notes) std::cout << "note: " << note << '\n';
  std::cout << "  frame     ms min  ms median   contacts       self     pair tests       hashes      boxes\n";
  for (std::size_t f = 0; f < rows.size(); ++f) {
    const DetectRow& r = rows[f];
    std::cout << fmt::format("{:7} {:10.3f} {:10.3f} {:10} {:10} {:14} {:12} {:10}\n", f, r.times.min(),
                             r.times.median(), r.contacts, r.self_contacts, r.counters.pair_tests, r.counters.hashes,
                             r.counters.boxes);
  }
}

}  // namespace

void detect(const Options& options) {
  const collide::Method& method = chosen_method(options.detection, collide::default_method);
  collide::Settings settings;
  settings.self_collision = options.detect.self_collision;
  apply(options.detection, settings);
  const Sequence sequence = read_sequence(options.detect);
  if (automatic_cell_size(options.detection, true))
    settings.cell_size = collide::default_cell_size(sequence.frames[0].view(), settings.levels, settings.tolerance);
  const std::vector<DetectRow> rows = run(options, method, settings, sequence);
  std::vector<std::string> notes = warnings(method, settings);
  std::ranges::copy(sequence.notes, std::back_inserter(notes));
  if (options.json)
    print_json(options, method, notes, sequence.bodies(), rows);
  else
    print_table(options, method, notes, sequence.bodies(), rows);
}

}  // namespace app::cli
