#include "app/options.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <thread>

#include <CLI/CLI.hpp>

#include "engine/resources.h"
#include "softbody/integrators.h"

namespace app {
namespace {

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// "1280x720" to width and height.
void parse_size(const std::string& text, Options& options) {
  std::istringstream in(text);
  char x = 0;
  constexpr int limit = 16384;
  const bool ok = (in >> options.width >> x >> options.height) && x == 'x' && in.peek() == EOF;
  if (!ok || options.width < 1 || options.height < 1 || options.width > limit || options.height > limit)
    throw UsageError("--size " + text + ": must be WIDTHxHEIGHT, each from 1 to 16384, e.g. 1280x720");
}

void parse_captures(const std::string& text, Options& options) {
  std::istringstream in(text);
  std::string item;
  while (std::getline(in, item, ',')) {
    int frame = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), frame);
    if (error != std::errc() || end != item.data() + item.size() || frame < 1)
      throw UsageError("--capture " + text + ": '" + item + "' is no frame number; write e.g. 100,400,600,800");
    if (frame > options.frames)
      throw UsageError("--capture " + text + ": frame " + item + " lies beyond --frames " +
                       std::to_string(options.frames));
    options.captures.push_back(frame);
  }
  if (options.captures.empty()) throw UsageError("--capture: names no frame; write e.g. 100,400,600,800");
  std::sort(options.captures.begin(), options.captures.end());
}

void add_scene_options(CLI::App& command, Options& options) {
  command.add_option("--scene", options.scene, "scene: a key of `list scenes` or a .toml file")->type_name("S");
  auto& d = options.detection;
  command.add_option("--method", d.method, "detector: a key of `list methods`")->type_name("M");
  command.add_option("--levels", d.levels, "subdivision level: each body's box is cut into 2^N boxes (0-15)")
      ->type_name("N");
  command.add_option("--buckets", d.buckets, "number of buckets of the hash table")->type_name("N");
  command.add_option("--cell-size", d.cell_size, "side of a grid cell in metres")->type_name("S");
  command.add_option("--tolerance", d.tolerance, "collision tolerance in metres")->type_name("H");
  command.add_option("--threads", options.threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
}

void check(const Options& options) {
  if (!softbody::find_integrator(options.integrator))
    throw UsageError("--integrator " + options.integrator + ": unknown; use one of: " + softbody::integrator_keys());
  if (!(options.frame_time >= 1e-6 && options.frame_time <= 1))
    throw UsageError("--dt: must be a number of seconds from 1e-6 to 1, e.g. 0.0166667");
}

}  // namespace

std::filesystem::path scene_folder() { return engine::find_folder("assets") / "scenes"; }

std::optional<Options> parse_options(int argc, const char* const* argv) {
  Options options;
  options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.integrator = softbody::default_integrator;
  std::string size, captures;

  CLI::App cli{
      "Soft spheres fall on a solid sphere while a detector finds their collisions and self-collisions.\n"
      "Without a command it opens the demo window.",
      "sbcollide"};
  cli.set_version_flag("--version", SBCOLLIDE_VERSION);
  cli.require_subcommand(0, 1);
  add_scene_options(cli, options);
  cli.add_option("--size", size, "size of the window or the pictures in pixels")->type_name("WxH");

  CLI::App* simulate = cli.add_subcommand("simulate", "run a scene without a window");
  add_scene_options(*simulate, options);
  simulate->add_option("--frames", options.frames, "frames to run")->type_name("N")->check(CLI::Range(1, 10'000'000));
  simulate->add_option("--integrator", options.integrator, "a key of `list integrators`")->type_name("I");
  simulate->add_option("--dt", options.frame_time, "length of a frame in seconds (default 1/60)")->type_name("SECONDS");
  simulate->add_option("--capture", captures, "frames to write as pictures, e.g. 100,400,600,800")
      ->type_name("N,N,...");
  simulate->add_option("--size", size, "size of the pictures in pixels (default 1280x720)")->type_name("WxH");
  simulate->add_option("--out", options.out, "folder for the pictures (default: the current one)")->type_name("DIR");
  simulate->add_flag("--json", options.json, "print one JSON document instead of a table");

  CLI::App* list = cli.add_subcommand("list", "print keys and names, a line each");
  list->add_option("what", options.list_of, "scenes, methods or integrators")
      ->required()
      ->check(CLI::IsMember({"scenes", "methods", "integrators"}));

  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    cli.exit(asked);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error.what()) + "; see sbcollide --help");
  }
  options.command = *simulate ? Command::simulate : *list ? Command::list : Command::demo;
  if (!size.empty()) parse_size(size, options);
  if (simulate->count("--capture")) parse_captures(captures, options);
  check(options);
  return options;
}

softbody::Scene load_scene(const Options& options) {
  softbody::Scene scene = softbody::find_scene(options.scene, scene_folder());
  const DetectionOptions& d = options.detection;
  if (d.method) {
    if (!collide::find_method(*d.method))
      throw UsageError("--method " + *d.method + ": unknown; use one of: " + collide::method_keys());
    scene.method = *d.method;
  }
  if (d.levels) scene.collision.levels = *d.levels;
  if (d.buckets) {
    if (*d.buckets < 1 || *d.buckets > collide::max_buckets)
      throw UsageError("--buckets " + std::to_string(*d.buckets) + ": must be from 1 to " +
                       std::to_string(collide::max_buckets));
    scene.collision.buckets = static_cast<std::uint32_t>(*d.buckets);
  }
  if (d.tolerance) scene.collision.tolerance = static_cast<float>(*d.tolerance);
  if (d.cell_size) {
    scene.collision.cell_size = glm::vec3(static_cast<float>(*d.cell_size));
    scene.default_cell_size = false;
  }
  if (const std::string wrong = collide::problem(scene.collision); !wrong.empty()) throw UsageError(wrong);
  return scene;
}

}  // namespace app
