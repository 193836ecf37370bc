// bench_step: the whole step of a pile of stiff soft bodies, beside Bullet's, on the same scene.

#include <algorithm>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "app/base/usage_error.h"
#include "tests/bench/step/report.h"

namespace {

struct Options {
  int frames = 120, repeat = 1;
  std::vector<std::string> only, gases;
  bool json = false, csv = false;
};

template <class Known>
void require_known(const std::vector<std::string>& keys, const char* option, std::span<const Known> all) {
  for (const std::string& key : keys)
    if (std::ranges::none_of(all, [&](const Known& k) { return k.key == key; })) {
      std::string known;
      for (const Known& k : all) known.append(known.empty() ? "" : ", ").append(k.key);
      throw app::UsageError(std::string(option) + " " + key + ": unknown; use one of: " + known);
    }
}

bool asked_for(const std::vector<std::string>& keys, std::string_view key) {
  return keys.empty() || std::ranges::find(keys, key) != keys.end();
}

void compare(const Options& options) {
  std::vector<const bench::Entrant*> entrants;
  for (const bench::Entrant& e : bench::entrants())
    if (entrants.size() < 2 || asked_for(options.only, e.key)) entrants.push_back(&e);
  std::vector<bench::Result> all;
  for (const bench::Gas& gas : bench::gases()) {
    if (!asked_for(options.gases, gas.key)) continue;
    const bench::Course course{&gas, options.frames, options.repeat};
    all.push_back({course, bench::run(course, entrants)});
    if (!options.json && !options.csv) bench::print_table(all.back());
  }
  if (options.json) bench::print_json(all);
  if (options.csv) bench::print_csv(all);
}

int parse_and_run(int argc, char** argv) {
  Options options;
  CLI::App cli{"Times the whole step of 47 stiff soft bodies beside Bullet's, on one thread.", "bench_step"};
  cli.add_option("--frames", options.frames, "frames of 1/60 s")->check(CLI::Range(1, 100'000))->capture_default_str();
  cli.add_option("--repeat", options.repeat, "runs of each, of whose times the least counts, frame by frame")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  cli.add_option("--gas", options.gases, "only these: mild, mild-x100, scene");
  cli.add_option("--only", options.only, "entrants, beside the first two (default: all)");
  CLI::Option* json = cli.add_flag("--json", options.json, "print one JSON document instead of tables");
  cli.add_flag("--csv", options.csv, "print one table as CSV instead")->excludes(json);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return cli.exit(asked);
  }
  require_known(options.only, "--only", bench::entrants());
  require_known(options.gases, "--gas", bench::gases());
  compare(options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_step: %s\n", error.what());
    return 2;
  }
}
