#include "app/cli/detect.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <iterator>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/base/times.h"
#include "app/files/contacts_csv.h"
#include "app/files/obj.h"

namespace app {
namespace {

using collide::Index;

/// All that is read from the files, which are consecutive frames of the same bodies.
struct Sequence {
  std::vector<ObjBodies> frames;  // only the first keeps its edges, and only until the bodies are made
  collide::Bodies bodies;
  std::vector<std::string> notes;  // the first file's as they are; those that only another file has with its name

  /// Adds the notes of a file.
  void note(const std::string& file, const ObjBodies& read) {
    for (const std::string& text : read.notes) {
      if (std::ranges::find(notes, text) == notes.end())
        notes.push_back(frames.size() == 1 && &read == &frames[0] ? text : file + ": " + text);
    }
  }

  collide::Frame frame(std::size_t number) const {
    const ObjBodies& f = frames[number];
    return {f.x, f.y, f.z, &bodies};
  }
};

void require_match(const ObjBodies& bodies, const std::string& file, const ObjBodies& first,
                   const std::string& first_file) {
  const auto refuse = [&](const std::string& what, std::size_t here, std::size_t there) {
    throw UsageError(file + ": " + what + " " + std::to_string(here) + ", in " + first_file + " " +
                     std::to_string(there) + "; give files that match body by body");
  };
  if (bodies.count() != first.count()) refuse("number of bodies", bodies.count(), first.count());
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    if (bodies.size(b) != first.size(b)) refuse("vertices of body " + std::to_string(b), bodies.size(b), first.size(b));
  }
}

/// `rest`: nullptr, or what matches `mesh`. Copies of one mesh, one after another, share their topology.
collide::Bodies make_bodies(const ObjBodies& mesh, const ObjBodies* rest) {
  collide::Bodies bodies;
  std::shared_ptr<const collide::Topology> topology;
  for (std::size_t b = 0; b < mesh.count(); ++b) {
    if (b == 0 || mesh.size(b) != mesh.size(b - 1) || mesh.edges[b] != mesh.edges[b - 1])
      topology = std::make_shared<collide::Topology>(mesh.size(b), mesh.edges[b]);
    std::vector<glm::vec3> positions;
    for (Index v = mesh.first[b]; rest && v < mesh.first[b + 1]; ++v)
      positions.emplace_back(rest->x[v], rest->y[v], rest->z[v]);
    bodies.add(std::make_shared<collide::Shape>(topology, std::move(positions)));
  }
  return bodies;
}

/// Frames stay in memory, so that to read them is no part of the times.
constexpr std::size_t most_positions = std::size_t{1} << 27;  // of all frames together, 1.5 GiB

Sequence read_sequence(const DetectOptions& options) {
  Sequence sequence;
  const std::string& first_file = options.files.front();
  for (const std::string& file : options.files) {
    sequence.frames.push_back(read_obj(file));
    sequence.note(file, sequence.frames.back());
    require_match(sequence.frames.back(), file, sequence.frames.front(), first_file);
    if (sequence.frames.size() > 1) sequence.frames.back().edges = {};
    const std::size_t vertices = sequence.frames.front().x.size(), files = options.files.size();
    if (vertices * files > most_positions)
      throw UsageError(std::to_string(files) + " files of " + std::to_string(vertices) + " vertices each: at most " +
                       std::to_string(most_positions) + " together; give fewer files at a time");
  }
  ObjBodies& first = sequence.frames.front();
  if (options.rest) {
    const ObjBodies rest = read_obj(*options.rest);
    sequence.note(*options.rest, rest);
    require_match(rest, *options.rest, first, first_file);
    sequence.bodies = make_bodies(first, &rest);
  } else {
    sequence.bodies = make_bodies(first, nullptr);
  }
  first.edges = {};
  return sequence;
}

/// Figures of one frame.
struct MethodRow {
  std::size_t contacts = 0;
  std::uint64_t self_contacts = 0;
  collide::Counters counters;
  collide::Skipped skipped{};
  Times times;  // of each repetition
};

/// From positions in memory to the finished list.
double timed_detect(collide::Detector& detector, const collide::Frame& frame, const collide::Settings& settings,
                    collide::Workers& workers, collide::Result& result, const std::string& file) {
  const auto start = std::chrono::steady_clock::now();
  try {
    detector.detect(frame, settings, workers, result);
  } catch (const std::length_error& error) {  // more than the method may take
    throw UsageError(file + ": " + error.what());
  }
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<MethodRow> run(const Options& options, const collide::Method& method, const collide::Settings& settings,
                           const Sequence& sequence) {
  std::optional<ContactsCsv> csv;
  if (options.detect.contacts) csv.emplace(*options.detect.contacts);
  collide::Workers workers(options.threads);
  collide::Result result;
  std::vector<MethodRow> rows(sequence.frames.size());
  for (int repetition = 0; repetition < options.detect.repeat; ++repetition) {
    auto detector = method.make();
    for (std::size_t f = 0; f < rows.size(); ++f) {
      if (!options.detect.reuse) detector->forget();
      const collide::Frame frame = sequence.frame(f);
      rows[f].times.ms.push_back(timed_detect(*detector, frame, settings, workers, result, options.detect.files[f]));
      if (repetition > 0) continue;
      rows[f].contacts = result.contacts.size();
      rows[f].self_contacts = result.self_contacts;
      rows[f].counters = result.counters;
      rows[f].skipped = result.skipped;
      if (csv) csv->add(f, frame, result.contacts);  // at once: the lists of all frames may be too large to keep
    }
  }
  if (csv) csv->commit();
  return rows;
}

void print_json(const Options& options, const collide::Method& method, const std::vector<std::string>& notes,
                const collide::Bodies& bodies, const std::vector<MethodRow>& rows) {
  using Json = nlohmann::ordered_json;
  Json frames = Json::array();
  for (const MethodRow& r : rows) {
    Json skipped = Json::object();
    for (std::size_t kind = 0; kind < r.skipped.size(); ++kind)
      skipped[std::string(collide::skip_kinds[kind].key)] = r.skipped[kind];
    frames.push_back({{"frame", frames.size()},
                      {"contacts", r.contacts},
                      {"self_contacts", r.self_contacts},
                      {"ms", {{"min", r.times.least()}, {"median", r.times.median()}}},
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
                 const collide::Bodies& bodies, const std::vector<MethodRow>& rows) {
  std::cout << fmt::format("{}, tolerance {:g} m, threads {}, bodies {}, vertices {}\n", method.name,
                           *options.detection.tolerance, options.threads, bodies.count(), bodies.vertex_count());
  for (const std::string& note : notes) std::cout << "note: " << note << '\n';
  std::cout << "  frame     ms min  ms median   contacts       self     pair tests       hashes      boxes\n";
  for (std::size_t f = 0; f < rows.size(); ++f) {
    const MethodRow& r = rows[f];
    std::cout << fmt::format("{:7} {:10.3f} {:10.3f} {:10} {:10} {:14} {:12} {:10}\n", f, r.times.least(),
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
    settings.cell_size = collide::default_cell_size(sequence.frame(0), settings.levels, settings.tolerance);
  const std::vector<MethodRow> rows = run(options, method, settings, sequence);
  std::vector<std::string> notes = warnings(method, settings);
  std::ranges::copy(sequence.notes, std::back_inserter(notes));
  if (options.json)
    print_json(options, method, notes, sequence.bodies, rows);
  else
    print_table(options, method, notes, sequence.bodies, rows);
}

}  // namespace app
