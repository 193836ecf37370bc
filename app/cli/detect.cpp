#include "app/cli/commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
#include <utility>

#include <fmt/compile.h>
#include <nlohmann/json.hpp>

#include "app/cli/method_runs.h"
#include "app/compare/score.h"
#include "app/files/output_file.h"

namespace app::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view all_methods = "all";  // in place of a method's key

// All frames stay in memory, so that the times do not include reading.
constexpr std::size_t max_positions = std::size_t{1} << 27;  // of all frames together: 1.5 GiB

/// Returns what is to be said if the floats that hold the positions are far apart beside the tolerance; else nothing.
std::string rounding_note(const SequenceTask& task) {
  constexpr double spacing = 0x1p-23, small = 1.0 / 16;  // of neighbouring floats, relative; of the tolerance
  double farthest = 0;
  for (const files::SequenceFrame& frame : task.frames)
    for (const auto& axis : {frame.view().x, frame.view().y, frame.view().z})
      for (const float value : axis) farthest = std::max(farthest, std::abs(double{value}));
  if (farthest * spacing <= small * task.tolerance) return {};
  return fmt::format(
      "coordinates of {:.3g} m are kept as floats, which are {:.2g} m apart there, beside a tolerance of "
      "{:g} m: move the bodies near the origin",
      farthest, farthest * spacing, task.tolerance);
}

/// Returns the task without its settings.
SequenceTask read_sequence(const Options& options) {
  const DetectOptions& d = options.detect;
  files::FrameSequence sequence({d.files.begin(), d.files.end()}, {.by = d.by, .rest = d.rest});
  const std::size_t vertices = sequence.bodies()->bodies.vertex_count();
  if (vertices * sequence.count() > max_positions)
    throw UsageError(fmt::format("{} files of {} vertices each: at most {} together; give fewer files at a time",
                                 sequence.count(), vertices, max_positions));
  SequenceTask task{.files = d.files,
                    .tolerance = *options.detection.tolerance,
                    .threads = options.threads,
                    .repeat = d.repeat,
                    .reuse = d.reuse};
  for (std::size_t f = 0; f < sequence.count(); ++f) task.frames.push_back(sequence.read(f));
  task.notes = sequence.notes();
  if (const std::string note = rounding_note(task); !note.empty()) task.notes.push_back(note);
  return task;
}

/// A pair as the CSV file and the JSON document name it.
struct PairInFile {
  std::size_t frame;
  collide::Index vertex_a, vertex_b, body_a, body_b;
  double distance;  // m
};

PairInFile in_file(const SequenceTask& task, std::size_t frame, collide::Contact contact) {
  const std::vector<collide::Index>& file_vertex = task.of().meshes.file_vertex;
  const collide::Bodies& bodies = task.of().bodies;
  const double distance{compare::distance(contact, task.frames[frame].view())};
  if (file_vertex[contact.a] > file_vertex[contact.b]) std::swap(contact.a, contact.b);
  return {frame,   file_vertex[contact.a], file_vertex[contact.b], bodies.body_of(contact.a), bodies.body_of(contact.b),
          distance};
}

/// Sorts the contacts of a frame by the numbers that vertices have in the file, and writes a line for each.
void write_contacts(files::OutputFile& csv, const SequenceTask& task, std::size_t frame,
                    std::vector<collide::Contact>& contacts) {
  const std::vector<collide::Index>& file_vertex = task.of().meshes.file_vertex;
  const auto vertices = [&](const collide::Contact& c) -> std::pair<collide::Index, collide::Index> {
    return std::minmax(file_vertex[c.a], file_vertex[c.b]);
  };
  if (!std::ranges::is_sorted(contacts, {}, vertices)) std::ranges::sort(contacts, {}, vertices);
  std::array<char, 160> line;  // five integers of at most 20 digits, and a real number
  for (const collide::Contact& contact : contacts) {
    const PairInFile p = in_file(task, frame, contact);
    // A compiled format, since a table may have millions of lines.
    const char* const end = fmt::format_to(line.data(), FMT_COMPILE("{},{},{},{},{},{:.9g}\n"), p.frame, p.vertex_a,
                                           p.vertex_b, p.body_a, p.body_b, p.distance);
    csv.write({line.data(), end});
  }
}

/// The sums over the frames that a method reached.
struct Totals {
  std::size_t contacts = 0;
  std::uint64_t pair_tests = 0, hashes = 0;
  double ms = 0;                            // of the frames' medians
  std::optional<double> recall, precision;  // over the frames whose true contacts are known
  std::optional<PairInFile> first_missed, first_false;
};

/// Returns the sums over `rows`, which begin with the frame `first`.
Totals totals_of(const SequenceTask& task, std::span<const DetectRow> rows, std::size_t first = 0) {
  Totals sum;
  std::size_t judged = 0;  // contacts
  Found all;
  for (const DetectRow& r : rows) {
    sum.contacts += r.contacts;
    sum.pair_tests += r.counters.pair_tests;
    sum.hashes += r.counters.hashes;
    sum.ms += r.times.median();
    if (!r.found) continue;
    judged += r.contacts;
    all.true_contacts += r.found->true_contacts;
    all.of_them += r.found->of_them;
    sum.recall = compare::share(all.of_them, all.true_contacts);
    sum.precision = compare::share(all.of_them, judged);
    const std::size_t frame = first + std::size_t(&r - rows.data());
    const Found& found = *r.found;
    if (found.first_missed && !sum.first_missed) sum.first_missed = in_file(task, frame, *found.first_missed);
    if (found.first_false && !sum.first_false) sum.first_false = in_file(task, frame, *found.first_false);
  }
  return sum;
}

// ---- JSON ----

Json to_json(const std::optional<PairInFile>& p) {
  if (!p) return nullptr;
  return {{"frame", p->frame},   {"vertex_a", p->vertex_a}, {"vertex_b", p->vertex_b},
          {"body_a", p->body_a}, {"body_b", p->body_b},     {"distance", p->distance}};
}

/// Adds what is right and wrong in these frames; null where the true contacts are not known.
void add_score(Json& object, const Totals& sum) {
  object["recall"] = sum.recall ? Json(*sum.recall) : Json(nullptr);
  object["precision"] = sum.precision ? Json(*sum.precision) : Json(nullptr);
  object["first_missed"] = to_json(sum.first_missed);
  object["first_false"] = to_json(sum.first_false);
}

Json frames_json(const SequenceTask& task, const MethodRun& run, bool scored) {
  Json frames = Json::array();
  for (const DetectRow& r : run.rows) {
    Json skipped = Json::object();
    for (std::size_t kind = 0; kind < r.skipped.size(); ++kind)
      skipped[std::string(collide::skip_kinds[kind].key)] = r.skipped[kind];
    Json& frame = frames.emplace_back(Json{{"frame", frames.size()},
                                           {"contacts", r.contacts},
                                           {"self_contacts", r.self_contacts},
                                           {"ms", {{"min", r.times.min()}, {"median", r.times.median()}}},
                                           {"pair_tests", r.counters.pair_tests},
                                           {"hashes", r.counters.hashes},
                                           {"boxes", r.counters.boxes},
                                           {"skipped", skipped}});
    if (scored) add_score(frame, totals_of(task, std::span(&r, 1), frames.size() - 1));
  }
  return frames;
}

std::vector<std::string> notes_for(const collide::Method& method, const SequenceTask& task) {
  std::vector<std::string> all = warnings(method, task.settings);
  std::ranges::copy(task.notes, std::back_inserter(all));
  return all;
}

/// Returns what one method gives. compared: nullptr, or all runs, of which this is one.
Json to_json(const SequenceTask& task, const MethodRun& run, const MethodRuns* compared) {
  const glm::vec3& cell = *task.settings.cell_size;
  Json document{{"method", run.method->key},
                {"tolerance", task.tolerance},
                {"cell_size", {cell.x, cell.y, cell.z}},
                {"threads", task.threads},
                {"bodies", task.of().bodies.count()},
                {"vertices", task.of().bodies.vertex_count()},
                {"warnings", notes_for(*run.method, task)}};
  const bool scored = compared && compared->reference;
  if (compared) {
    document["reference"] = scored ? Json(compared->reference->key) : Json(nullptr);
    if (scored) add_score(document, totals_of(task, run.rows));
    if (!run.not_run.empty()) document["not_run"] = run.not_run;
  }
  document["frames"] = frames_json(task, run, scored);
  return document;
}

// ---- tables ----

void print_heading(const SequenceTask& task, std::string_view method, const std::vector<std::string>& notes) {
  const glm::vec3& cell = *task.settings.cell_size;
  std::cout << fmt::format(
      "{}, tolerance {:g} m, cells of {:.3g} x {:.3g} x {:.3g} m, threads {}, bodies {}, vertices {}\n", method,
      task.tolerance, cell.x, cell.y, cell.z, task.threads, task.of().bodies.count(), task.of().bodies.vertex_count());
  for (const std::string& note : notes) std::cout << "note: " << note << '\n';
}

/// Returns a count of a method; that of a guest is not known.
std::string count_text(const collide::Method& method, std::uint64_t count) {
  return method.can_drive() ? std::to_string(count) : "-";
}

void print_table(const SequenceTask& task, const MethodRun& run) {
  print_heading(task, run.method->name, notes_for(*run.method, task));
  std::cout << "  frame     ms min  ms median   contacts       self     pair tests       hashes      boxes\n";
  for (std::size_t f = 0; f < run.rows.size(); ++f) {
    const DetectRow& r = run.rows[f];
    const auto counted = [&](std::uint64_t count) { return count_text(*run.method, count); };
    std::cout << fmt::format("{:7} {:10.3f} {:10.3f} {:10} {:10} {:>14} {:>12} {:>10}\n", f, r.times.min(),
                             r.times.median(), r.contacts, r.self_contacts, counted(r.counters.pair_tests),
                             counted(r.counters.hashes), counted(r.counters.boxes));
  }
}

void print_table(const SequenceTask& task, const MethodRuns& all) {
  std::vector<std::string> notes = task.notes;
  for (const MethodRun& run : all.runs)
    for (const std::string& note : warnings(*run.method, task.settings))
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  print_heading(task, "All methods", notes);
  std::cout << fmt::format(
      "frames {}: their contacts, tests and hashes together, mean time of one; true contacts: {}\n", task.frames.size(),
      all.reference ? all.reference->name : "not known");
  std::cout << fmt::format("{:28} {:>10} {:>8} {:>9} {:>12} {:>15} {:>14}\n", "method", "contacts", "recall",
                           "precision", "ms a frame", "pair tests", "hashes");
  const auto share = [](std::optional<double> value) -> std::string {
    if (!value) return "-";
    return *value < 1 ? fmt::format("{:.5f}", std::floor(1e5 * *value) / 1e5) : "1";  // 1 only where nothing is wrong
  };
  for (const MethodRun& run : all.runs) {
    if (!run.not_run.empty()) {
      std::cout << fmt::format("{:28} not run {}\n", run.method->key, run.not_run);
      continue;
    }
    const Totals sum = totals_of(task, run.rows);
    std::cout << fmt::format("{:28} {:10} {:>8} {:>9} {:12.3f} {:>15} {:>14}\n", run.method->key, sum.contacts,
                             share(sum.recall), share(sum.precision), sum.ms / double(run.rows.size()),
                             count_text(*run.method, sum.pair_tests), count_text(*run.method, sum.hashes));
    for (const auto& [kind, pair] : {std::pair("missed", sum.first_missed), std::pair("false", sum.first_false)})
      if (pair)
        std::cout << fmt::format("  first {}: vertices {} and {} in frame {}, {:.6g} m apart\n", kind, pair->vertex_a,
                                 pair->vertex_b, pair->frame, pair->distance);
  }
}

}  // namespace

void detect(const Options& options) {
  if (options.detect.continuous) return detect_continuous(options);
  const bool compares = options.detection.method == all_methods;
  if (options.guests.size() > 1 && !options.detection.method)
    throw UsageError("--guest: is there more than once; name one by --method, or all with --method all");
  const std::string_view otherwise =
      options.guests.empty() ? collide::default_method : collide::method_table().back().key;
  const collide::Method* method = compares ? nullptr : &chosen_method(options.detection, otherwise);
  if (compares && options.detect.contacts)
    throw UsageError("--contacts " + options.detect.contacts->string() +
                     ": has the contacts of one method; name it with --method");
  collide::Settings settings;
  settings.self_collision = options.detect.self_collision;
  apply(options.detection, settings);
  SequenceTask task = read_sequence(options);
  task.settings = settings;
  if (!settings.cell_size)
    task.settings.cell_size = collide::automatic_cell_size(task.frames[0].view(), settings.levels, settings.tolerance);
  if (compares) {
    const MethodRuns all = run_all_methods(task);
    if (!options.json) return print_table(task, all);
    Json list = Json::array();
    for (const MethodRun& run : all.runs) list.push_back(to_json(task, run, &all));
    // What a guest has said may be no UTF-8.
    std::cout << list.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
    return;
  }
  std::optional<files::OutputFile> csv;
  if (options.detect.contacts)  // the heading protects a mesh that stands where the user forgot the name
    csv.emplace(*options.detect.contacts, "frame,vertex_a,vertex_b,body_a,body_b,distance\n");
  // The contacts are written at once, because the lists of all frames may be too large to keep.
  const MethodRun run = run_method(*method, task, [&](std::size_t frame, std::vector<collide::Contact>& contacts) {
    if (csv) write_contacts(*csv, task, frame, contacts);
  });
  if (csv) csv->commit();
  if (!options.json) return print_table(task, run);
  std::cout << to_json(task, run, nullptr).dump() << '\n';
}

}  // namespace app::cli
