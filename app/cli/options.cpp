#include "app/cli/options.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/core.h>
#include <hwy/targets.h>
#include <CLI/CLI.hpp>

#include "app/base/parse_numbers.h"
#include "app/base/text.h"
#include "app/files/inputs.h"
#include "app/files/playback.h"
#include "collide/api/guarded.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/world/world.h"

namespace app::cli {
namespace {

/// Returns why CLI11 refuses the command line, in one line.
std::string reason(const CLI::ParseError& error) {
  constexpr std::string_view value_of_flag = " was given a disallowed flag override";  // after its bare name
  constexpr std::string_view no_value = "Could not convert: ";                         // NAME = VALUE
  std::string why = error.what();
  while (why.ends_with('\n')) why.pop_back();
  std::ranges::replace(why, '\n', ' ');
  if (why.starts_with(no_value)) return why.substr(no_value.size()) + ": is no number; write e.g. 0.25";
  if (!why.ends_with(value_of_flag)) return why;
  return "--" + why.substr(0, why.size() - value_of_flag.size()) + ": a flag, to be written without a value";
}

/// Returns how many letters must be added, taken out or changed to make one word of the other.
std::size_t distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);  // of the beginnings of `to` from the present beginning of `from`
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j)
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, diagonal + (from[i] != to[j])}));
  }
  return row.back();
}

/// Returns "; did you mean --levels? See " if a word that was not expected is nearly a name, else "; see ".
std::string suggestion(const CLI::App& cli) {
  const auto given = cli.get_subcommands();
  const CLI::App& command = given.empty() ? cli : *given.front();
  std::vector<std::string> names;
  for (const CLI::App* below : command.get_subcommands({})) names.push_back(below->get_name());
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& argument : cli.remaining(true)) {
    const std::string word = argument.substr(0, argument.find('='));
    const auto from_word = [&](const std::string& name) { return distance(word, name); };
    const std::string nearest = std::ranges::min(names, {}, from_word);
    if (3 * from_word(nearest) <= word.size()) return "; did you mean " + nearest + "? See ";
  }
  return "; see ";
}

/// Reads width and height, e.g. "1280x720".
glm::ivec2 parse_size(const std::string& text) {
  const auto parts = split(text, 'x');
  const auto side = [&](std::size_t which) {
    const auto pixels = parts.size() == 2 ? parse_integer(parts[which]) : std::nullopt;
    if (!pixels || *pixels < 1 || *pixels > 16384)
      throw UsageError("--size " + text + ": must be WIDTHxHEIGHT, each from 1 to 16384, e.g. 1280x720");
    return int(*pixels);
  };
  return {side(0), side(1)};
}

void parse_captures(const std::string& text, Options& options) {
  const auto refuse = [&](std::string_view item, const std::string& why) {
    throw UsageError("--capture " + text + ": '" + std::string(item) + "' " + why);
  };
  for (const std::string_view item : split(text, ',')) {
    const auto frame = parse_integer(item);
    if (!frame || *frame < 1) refuse(item, "is no frame number; write e.g. 100,400,600,800");
    if (*frame > options.frames) refuse(item, "lies beyond --frames " + std::to_string(options.frames));
    options.captures.push_back(int(*frame));
  }
  std::sort(options.captures.begin(), options.captures.end());
}

softbody::View read_view(const std::string& text) {
  const auto v = parse_reals(text, ',');
  const auto within = [&](std::size_t which, double min, double max) {
    return (*v)[which] >= min && (*v)[which] <= max;
  };
  if (!v || v->size() != 6 || !within(0, -1e6, 1e6) || !within(1, -1e6, 1e6) || !within(2, -1e6, 1e6) ||
      !within(3, 1e-9, 1e6) || !within(4, -360, 360) || !within(5, -89, 89))
    throw UsageError("--view " + text +
                     ": must be X,Y,Z,DISTANCE,AZIMUTH,ELEVATION: where to look at and how far from in metres, -360 to "
                     "360 and -89 to 89 degrees, e.g. 0,0.8,0,8,30,18");
  return {.target = {(*v)[0], (*v)[1], (*v)[2]}, .distance = (*v)[3], .azimuth = (*v)[4], .elevation = (*v)[5]};
}

const std::vector<std::string>& beside_keys() {
  static const std::vector<std::string> keys{"method",    "levels",          "cell-size", "buckets",
                                             "tolerance", "contact-surface", "integrator"};
  return keys;
}

/// Returns "--levels=3" and so on for "levels=3,...", each key once. A cell size may have commas in it.
std::vector<std::string> beside_arguments(const std::string& text) {
  std::vector<std::string> arguments, given;
  for (const std::string_view item : split(text, ',')) {
    const auto equals = item.find('=');
    if (equals == std::string_view::npos && !given.empty() && given.back() == "cell-size") {
      arguments.back().append(",").append(item);
      continue;
    }
    const std::string key(item.substr(0, equals));
    if (std::ranges::count(beside_keys(), key) == 0)
      throw UsageError("'" + key + "' is none of: " + joined(beside_keys(), ", "));
    if (std::ranges::count(given, key) > 0) throw UsageError(key + ": is given twice");
    if (equals == std::string_view::npos || equals + 1 == item.size())
      throw UsageError(key + ": its value is missing; write e.g. method=multi-level-sb,cell-size=0.3");
    given.push_back(key);
    arguments.push_back(fmt::format("--{}", item));
  }
  return arguments;
}

std::array<std::uint32_t, 3> read_primes(const std::string& text) {
  const auto parts = split(text, ',');
  const auto prime = [&](std::size_t axis) {
    const auto number = parts.size() == 3 ? parse_integer(parts[axis]) : std::nullopt;
    if (!number || *number < 1 || *number > std::numeric_limits<std::uint32_t>::max())
      throw UsageError("--primes " + text +
                       ": must be three whole numbers from 1 to 4294967295, e.g. 73856093,19349669,83492791");
    return static_cast<std::uint32_t>(*number);
  };
  return {prime(0), prime(1), prime(2)};
}

std::optional<glm::vec3> read_cell_size(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const auto sides = parse_reals(text, ',');
  if (!sides || (sides->size() != 1 && sides->size() != 3))
    throw UsageError("--cell-size " + text + ": must be a number of metres, three of them as X,Y,Z, or auto");
  return glm::vec3((*sides)[0], (*sides)[sides->size() / 2], sides->back());
}

/// Accepts decimal numbers from min to max. CLI::Range would call a fraction out of range.
CLI::Validator integer_in_range(std::int64_t min, std::int64_t max) {
  assert(min <= max);
  const std::string from = std::to_string(min), to = std::to_string(max);
  return CLI::Validator(
      [=](std::string& text) {
        const auto number = parse_integer(text);
        if (!number || *number < min || *number > max)
          return "must be a whole number from " + from + " to " + to + ", not " + text;
        text = std::to_string(*number);  // CLI11 would read 010 as 8
        return std::string();
      },
      "INT in [" + from + " - " + to + "]");
}

/// Adds an option with a value of this type, as the help calls it.
template <class Value>
CLI::Option* add(CLI::App& command, const char* name, const char* type, Value& value, const std::string& text) {
  return command.add_option(name, value, text)->type_name(type);
}
/// Adds an option for a whole number from min to max.
template <class Value>
void add(CLI::App& command, const char* name, const char* type, std::int64_t min, std::int64_t max, Value& value,
         const std::string& text) {
  add(command, name, type, value, text)->transform(integer_in_range(min, max));
}

void add_common_options(CLI::App& command, Options& options) {
  DetectionOptions& detection = options.detection;
  add(command, "--method", "M", detection.method, "detector: a key of `list methods`");
  add(command, "--levels", "N", 0, collide::max_levels, detection.levels,
      "subdivision level: each body's box is cut into 2^N boxes");
  add(command, "--buckets", "N", 1, collide::max_buckets, detection.buckets, "number of buckets of the hash table");
  add(command, "--cell-size", "S|X,Y,Z|auto", detection.cell_size,
      "sides of a grid cell in metres, or auto: as large as the largest subdivided box at rest + the tolerance");
  add(command, "--primes", "A,B,C", detection.primes,
      "factors of a cell's x, y and z in the hash function (default: 73856093,19349669,83492791)");
  add(command, "--tolerance", "H", detection.tolerance, "collision tolerance in metres");
  add(command, "--threads", "N", 1, 256, options.threads, "threads (default: all cores)");
}

void add_scene_options(CLI::App& command, Options& options, std::string& beside) {
  add(command, "--scene", "S", options.scene, "scene: a key of `list scenes` or a .toml file");
  add(command, "--beside", "KEY=VALUE,...", beside,
      "a second world beside the first that differs in these: " + joined(beside_keys(), ", "));
  add_common_options(command, options);
  add(command, "--contact-surface", "K", options.contact_surface,
      "what keeps bodies apart: a key of `list contact-surfaces`");
  add(command, "--integrator", "I", options.integrator.key, "a key of `list integrators`");
  add(command, "--substeps", "N", 1, softbody::max_fixed_substeps, options.integrator.substeps,
      "exactly N steps of the integrator a frame (default: as many as stability asks for)");
  command.add_flag_function(
      "--self,!--no-self", [&options](std::int64_t number) { options.self_collision = number > 0; },
      "whether pairs of one body count (default: the scene's)");
  command
      .add_option_function<std::string>(
          "--view", [&options](const std::string& text) { options.view = read_view(text); },
          "the camera: what it looks at, how far from, degrees round and up (default: the scene's)")
      ->type_name("X,Y,Z,DISTANCE,AZIMUTH,ELEVATION");
}

CLI::App* add_simulate(CLI::App& cli, Options& options, std::string& beside, std::string& size, std::string& captures) {
  CLI::App* simulate = cli.add_subcommand("simulate", "run a scene without a window");
  add_scene_options(*simulate, options, beside);
  add(*simulate, "--frames", "N", 1, 10'000'000, options.frames, "frames to run");
  add(*simulate, "--dt", "SECONDS", options.frame_time, "length of a frame in seconds (default 1/60)");
  add(*simulate, "--capture", "N,N,...", captures, "frames to write as pictures, e.g. 100,400,600,800");
  add(*simulate, "--animation", "FILE", options.animation,
      "animated image of the run in real time; a name ending in .webp");
  add(*simulate, "--size", "WxH", size, "size of the pictures in pixels (default 1280x720)");
  add(*simulate, "--obj-every", "N", 1, 10'000'000, options.obj_every,
      "write the bodies of every Nth frame as an OBJ file, for `detect`");
  add(*simulate, "--out", "DIR", options.out, "folder for pictures and OBJ files (default: the current one)");
  CLI::Option* json = simulate->add_flag("--json", options.json, "print one JSON document instead of a table");
  simulate
      ->add_flag("--json-lines", options.json_lines,
                 "print a line of JSON for each frame as soon as it is simulated, and one at the end with the rest")
      ->excludes(json);
  simulate->add_flag("--oracle", options.oracle,
                     "with --json or --json-lines: what overlaps and passes through in each frame; slow");
  return simulate;
}

void add_guest_option(CLI::App& command, Options& options) {
  add(command, "--guest", "FILE", options.guests,
      "a method of your own to compare: a source .c or .cpp, or a library .so; may be repeated")
      ->allow_extra_args(false);
}

void add_bodies_option(CLI::App& command, std::optional<files::BodiesBy>& by) {
  command
      .add_option_function<std::string>(
          "--bodies",
          [&by](const std::string& key) {
            const auto* choice = std::ranges::find(files::bodies_by_keys, key, &files::BodiesByKey::key);
            if (choice == files::bodies_by_keys.end())
              throw UsageError("--bodies " + key + ": unknown; use one of: objects, components, one");
            by = choice->value;
          },
          "what a body is: each object of a file, each part that faces connect, or all as one (default: objects for "
          "OBJ, components for PLY)")
      ->type_name("objects|components|one");
}

CLI::App* add_detect(CLI::App& cli, Options& options) {
  DetectOptions& d = options.detect;
  CLI::App* detect = cli.add_subcommand("detect", "find the contacts in meshes of your own");
  detect->add_option("FILE", d.files, "OBJ or PLY files: consecutive frames of the same bodies")->required();
  add_bodies_option(*detect, d.by);
  add_common_options(*detect, options);
  add_guest_option(*detect, options);
  detect->get_option("--method")->description("detector: a key of `list methods`, or all of them: compares them");
  detect->add_flag("--self,!--no-self", d.self_collision,
                   "whether pairs of one body count (default: yes; of both, the last one holds)");
  add(*detect, "--rest", "FILE", d.rest, "bodies at rest: no pair of one body counts that is closer than H there");
  add(*detect, "--repeat", "K", 1, 100'000, d.repeat, "runs of the whole sequence, each with a fresh detector");
  detect->add_flag("!--no-reuse", d.reuse, "forget what earlier frames taught");
  add(*detect, "--contacts", "CSV", d.contacts, "file to write the contacts to");
  detect->add_flag("--json", options.json, "print one JSON document instead of a table");
  CLI::Option* continuous = detect->add_flag(
      "--continuous", d.continuous,
      "of two files FROM and TO: all vertices and faces, edges and edges that meet on the straight way between them");
  for (const char* other :
       {"--tolerance", "--method", "--guest", "--bodies", "--self", "--rest", "--repeat", "--no-reuse"})
    continuous->excludes(detect->get_option(other));
  return detect;
}

CLI::App* add_report(CLI::App& cli, Options& options) {
  report::ReportOptions& r = options.report;
  CLI::App* report = cli.add_subcommand("report", "measure for minutes; write tables and plots");
  report->add_option("what", r.name, report::report_names(" or "));
  report->add_option("FILE", r.files, "detection: OBJ or PLY files, consecutive frames of your own in place of scenes");
  add(*report, "--tolerance", "H", r.tolerance, "of FILE: collision tolerance in metres");
  add_bodies_option(*report, r.by);
  add(*report, "--rest", "FILE", r.rest, "of FILE: bodies at rest, as for `detect`");
  add_guest_option(*report, options);
  add(*report, "--scene", "S", r.scene, "only this scene: a key of `list scenes` or a .toml file");
  report->add_flag("--quick", r.quick, "within a minute: fewer scenes, states and repetitions");
  add(*report, "--threads", "N", 1, 256, r.threads,
      "detection: threads of the detectors that are timed (default 1); contact and stability: runs side by "
      "side (default: all cores)");
  report->add_option("--out", r.out, "folder for the report")->type_name("DIR")->required();
  return report;
}

/// Throws UsageError for an empty value, which CLI11 would ignore, and for a forgotten value, for which CLI11 would
/// take the next option.
void refuse_missing_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty())
        throw UsageError(option->get_name() + ": the value is empty; give one or leave the option out");
      if (value.starts_with("--"))
        throw UsageError(option->get_name() + " " + value + ": its value is missing; a file of this name is ./" +
                         value);
    }
  }
  for (const CLI::App* below : command.get_subcommands()) refuse_missing_values(*below);
}

/// Makes CLI11 refuse values of flags. Otherwise it would add them up, and throw an error of another kind for
/// `--self=maybe`.
void refuse_values_of_flags(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) option->disable_flag_override();
  for (CLI::App* below : command.get_subcommands({})) refuse_values_of_flags(*below);
}

/// Throws UsageError if the animation cannot be written.
void check_animation(const Options& options) {
  constexpr int max_pictures = 10'000;  // bounds the memory that they take until the file is written
  constexpr int max_side = 16'383;      // a limit of WebP
  const std::string animation = "--animation " + options.animation->string();
  if (options.animation->extension() != ".webp")
    throw UsageError(animation + ": the name must end in .webp; no other kind of animation is written");
  if (const glm::ivec2 size = options.picture_size(); std::max(size.x, size.y) > max_side)
    throw UsageError(animation + ": must be at most " + std::to_string(max_side) +
                     " pixels wide and high; use a smaller --size");
  const int stride = frames_per_picture(options.frame_time);
  if ((options.frames - 1) / stride >= max_pictures)
    throw UsageError(animation + ": would have more than " + std::to_string(max_pictures) + " pictures; use --frames " +
                     std::to_string(max_pictures * stride) + " or fewer");
}

void check(const Options& options) {
  if (!softbody::find_integrator(options.integrator.key))
    throw UsageError("--integrator " + options.integrator.key +
                     ": unknown; use one of: " + softbody::integrator_keys());
  if (options.contact_surface && !softbody::find_contact_surface(*options.contact_surface))
    throw UsageError("--contact-surface " + *options.contact_surface +
                     ": unknown; use one of: " + softbody::contact_surface_keys());
  if (!(options.frame_time >= 1e-6 && options.frame_time <= 1))
    throw UsageError("--dt: must be a number of seconds from 1e-6 to 1, e.g. 0.0166667");
  if (options.obj_every && *options.obj_every > options.frames)
    throw UsageError("--obj-every " + std::to_string(*options.obj_every) + ": lies beyond --frames " +
                     std::to_string(options.frames) + ", so that no file would be written");
  if (options.oracle && !options.json && !options.json_lines)
    throw UsageError("--oracle: only --json and --json-lines print what it sees; add one of them");
  if (options.animation) check_animation(options);
}

/// Throws UsageError for what does not go with the report.
void check_report(const report::ReportOptions& r) {
  if (r.name.empty()) throw UsageError("report: say which one: " + report::report_names(" or "));
  if (r.files.empty()) {
    for (const auto& [option, given] : {std::pair("--tolerance", r.tolerance.has_value()),
                                        {"--bodies", r.by.has_value()},
                                        {"--rest", r.rest.has_value()}})
      if (given) throw UsageError(std::string(option) + ": goes with files; write report detection FILE...");
    return;
  }
  if (r.name != "detection")
    throw UsageError("report " + r.name + " " + r.files.front() + ": only report detection takes files");
  if (r.scene) throw UsageError("--scene " + *r.scene + ": goes without files; leave one of them out");
  if (!r.tolerance) throw UsageError("--tolerance: is missing; files need one, in metres");
  collide::Settings settings;
  apply({.tolerance = r.tolerance}, settings);
}

/// Throws UsageError for what does not go with recorded frames.
void check_play(const CLI::App& cli, const Options& options) {
  if (options.play.empty()) {
    if (options.bodies_by) throw UsageError("--bodies: goes with --play FILE... or `detect FILE...`");
    return;
  }
  if (options.command != Command::demo) throw UsageError("--play: only the window takes it; `detect` reads files, too");
  for (const char* other : {"--scene", "--mesh"})
    if (cli.count(other) > 0) throw UsageError(std::string(other) + ": leave it out, or --play: there is one of them");
  for (const char* other : {"--integrator", "--substeps", "--contact-surface", "--beside"})
    if (cli.count(other) > 0) throw UsageError(std::string(other) + ": leave it out: --play simulates nothing");
}

/// Returns the options with those of a second world.
Options read_beside(const std::string& text, const Options& first) try {
  Options second;
  second.integrator = first.integrator;
  std::string none;
  CLI::App parser;
  add_scene_options(parser, second, none);
  std::vector<std::string> arguments = beside_arguments(text);
  std::ranges::reverse(arguments);  // as CLI11 wants them
  try {
    parser.parse(arguments);
  } catch (const CLI::ParseError& error) {
    throw UsageError(reason(error));
  }
  check(second);
  return second;
} catch (const UsageError& error) {
  throw UsageError("--beside " + text + ": " + error.what());
}

/// Throws UsageError unless a scene file may have this length: a saved scene must be readable again.
void require_length(const std::string& option, double metres, const softbody::Key& key) {
  const auto [least, most] = key.limits;
  if (!(float(metres) >= float(least) && float(metres) <= float(most)))
    throw UsageError(option + fmt::format(": must be a number of metres from {:g} to {:.0f}", least, most));
}

}  // namespace

const collide::Method& chosen_method(const DetectionOptions& options, std::string_view otherwise) {
  const collide::Method* method = collide::find_method(options.method ? *options.method : otherwise);
  if (method) return *method;
  std::string guests;
  for (const collide::Method& row : collide::method_table())
    if (!row.can_drive()) guests += ", " + row.key;
  throw UsageError("--method " + *options.method + ": unknown; use one of: " + collide::method_keys() + guests);
}

void apply(const DetectionOptions& options, collide::Settings& settings) {
  assert(collide::problem(settings).empty());
  const auto check = [&](const std::string& option) {
    if (const std::string wrong = collide::problem(settings); !wrong.empty()) throw UsageError(option + ": " + wrong);
  };
  if (options.levels) settings.levels = *options.levels;
  if (options.buckets) settings.buckets = *options.buckets;
  if (options.tolerance) {
    settings.tolerance = float(*options.tolerance);
    check(fmt::format("--tolerance {:.9g}", *options.tolerance));
  }
  if (options.cell_size) settings.cell_size = read_cell_size(*options.cell_size);
  check("--cell-size");
  if (options.primes) settings.primes = read_primes(*options.primes);
}

std::vector<std::string> warnings(const collide::Method& method, const collide::Settings& settings) {
  std::string hash = method.uses_hash ? collide::hash_warning(settings) : "";
  if (hash.empty()) return {};
  return {std::move(hash)};
}

int frames_per_picture(double frame_time) {
  const double frames = 1 / (30 * frame_time);
  return std::max(1, int(std::ceil(frames - 0.01)));  // 0.0166667 is meant as 1/60
}

namespace {

/// Returns the version in a line, and below it what a report of a fault needs.
std::string version_text() {
  const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;  // the best one has the least bit
  return fmt::format("{}\ninstruction set: {}\ncompiler: {}\nlibraries: {}", SBCOLLIDE_VERSION,
                     hwy::TargetName(targets & -targets), SBCOLLIDE_COMPILER, SBCOLLIDE_LIBRARIES);
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
  Options options;
  options.threads = sbcollide::threads_of(0);  // all cores
  std::string size, captures, beside;

  CLI::App cli{
      "Soft spheres fall on a solid sphere while a detector finds their collisions and self-collisions.\n"
      "Without a command it opens the demo window.",
      "sbcollide"};
  cli.set_version_flag("--version", version_text)
      ->description("print the version and what a report of a fault needs, and exit");
  cli.require_subcommand(0, 1);
  add_scene_options(cli, options, beside);
  add(cli, "--size", "WxH", size, "size of the window or the pictures in pixels");
  cli.add_option("--mesh", options.meshes,
                 "OBJ or PLY files to open as soft bodies in the window; they join the scene of --scene if it is given")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);

  add(cli, "--play", "FILE", options.play,
      "OBJ or PLY files: recorded frames that the window plays; nothing is simulated");
  add_bodies_option(cli, options.bodies_by);
  add_guest_option(cli, options);

  const CLI::App* simulate = add_simulate(cli, options, beside, size, captures);
  const CLI::App* detect = add_detect(cli, options);
  const CLI::App* report = add_report(cli, options);
  CLI::App* list = cli.add_subcommand("list", "print keys and names, a line each");
  list->add_option("what", options.list_of, "scenes, methods, integrators or contact-surfaces (default: all)")
      ->check(CLI::IsMember({"scenes", "methods", "integrators", "contact-surfaces"}));
  CLI::App* new_method = cli.add_subcommand("new-method", "write a detector of your own to begin with, for --guest");
  add(*new_method, "FILE", "FILE", options.new_method, "the source to write: a new .c or .cpp file")->required();
  refuse_values_of_flags(cli);

  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    cli.exit(asked);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const auto below = cli.get_subcommands();
    const std::string command = below.empty() ? "" : below.front()->get_name() + " ";
    throw UsageError(reason(error) + suggestion(cli) + "sbcollide " + command + "--help");
  }
  refuse_missing_values(cli);
  if (*report) check_report(options.report);
  if (*detect && !options.detect.continuous && !options.detection.tolerance)
    throw UsageError("--tolerance: is missing; contacts need one, in metres, unless --continuous is given");
  options.command = *simulate     ? Command::simulate
                    : *detect     ? Command::detect
                    : *report     ? Command::report
                    : *list       ? Command::list
                    : *new_method ? Command::new_method
                                  : Command::demo;
  if (!options.meshes.empty() && options.command != Command::demo)
    throw UsageError("--mesh: only the window takes it; a scene file names meshes for `simulate`");
  const bool compares = options.command == Command::demo || options.command == Command::detect ||
                        (options.command == Command::report && options.report.name == "detection");
  if (!options.guests.empty() && !compares)
    throw UsageError("--guest: goes with the window, `detect` and `report detection`, which compare methods");
  check_play(cli, options);
  if (!size.empty()) options.size = parse_size(size);
  options.scene_given = cli.count("--scene") > 0;
  options.out_given = simulate->count("--out") > 0;
  if (simulate->count("--capture")) parse_captures(captures, options);
  check(options);
  if (!beside.empty()) options.beside.push_back(read_beside(beside, options));
  options.report.cores = options.threads;
  return options;
}

files::Opened open(const Options& options) {
  if (options.scene.ends_with(".obj") || options.scene.ends_with(".ply"))
    throw UsageError("--scene " + options.scene + ": a mesh, not a scene; `sbcollide --mesh` opens it in the window");
  files::Opened opened = options.play.empty()
                             ? softbody::find_scene(options.scene, files::scene_folder())
                             : files::open_recording({options.play.begin(), options.play.end()}, options.bodies_by);
  apply(options, opened.scene);
  return opened;
}

void apply(const Options& options, softbody::Scene& scene) {
  const bool may_be_saved = options.play.empty();
  const collide::Method& method = chosen_method(options.detection, scene.method);
  if (!method.can_drive())
    throw UsageError("--method " + method.key + ": a method of your own is only compared, it drives no bodies");
  scene.method = method.key;
  if (const auto tolerance = options.detection.tolerance; tolerance && may_be_saved)
    require_length(fmt::format("--tolerance {:.9g}", *tolerance), *tolerance, softbody::scene_key::tolerance);
  apply(options.detection, scene.collision);
  if (options.detection.cell_size && may_be_saved)
    for (const double side : softbody::numbers_of(scene.collision.cell_size))
      require_length("--cell-size " + *options.detection.cell_size, side, softbody::scene_key::cell_size);
  if (options.self_collision) scene.collision.self_collision = *options.self_collision;
  if (options.view) scene.view = *options.view;
  if (options.contact_surface) scene.contact_surface = softbody::find_contact_surface(*options.contact_surface)->value;
}

std::optional<compare::HowSimulated> second_world(const Options& options, const softbody::Scene& first) {
  if (options.beside.empty()) return std::nullopt;
  compare::HowSimulated second{first, options.beside.front().integrator};
  try {
    apply(options.beside.front(), second.scene);
  } catch (const UsageError& error) {
    throw UsageError(std::string("--beside: ") + error.what());
  }
  return second;
}

}  // namespace app::cli
