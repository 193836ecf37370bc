// bench_detection: records states, and times the project's detectors beside libraries on them or on meshes from files.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>

#include "app/cli/options.h"
#include "app/files/output_file.h"
#include "tests/bench/piles.h"
#include "tests/bench/report.h"

namespace {

struct Options {
  std::string folder;
  std::vector<std::filesystem::path> from;  // a folder of states, or files
  std::optional<std::filesystem::path> rest;
  int threads = 1, bodies = 0, repeat = 10;
  std::vector<float> tolerances;
  std::vector<std::string> only;  // keys of candidates beside the first; empty: all
  bool json = false, csv = false;
};

[[noreturn]] void fail_for_bodies(const Options& options) {
  throw app::UsageError("--bodies " + std::to_string(options.bodies) + ": no state has so many; leave it out for all");
}

void record(const Options& options) {
  app::files::prepare_folder(options.folder);
  bool any = false;
  for (const bench::Pile& pile : bench::piles()) {
    if (options.bodies > 0 && pile.bodies != options.bodies) continue;
    any = true;
    bench::State state = pile.make(options.threads);
    state.key = pile.key;
    bench::save(state, options.folder);
    std::printf("%s: %s; %zu frames, %.4f edges a frame\n", state.key.c_str(), std::string(pile.what).c_str(),
                state.frames.size(), bench::mean_displacement(state) / bench::mean_edge);
    std::fflush(stdout);
  }
  if (!any) fail_for_bodies(options);
}

/// The first candidate, which the others are divided by, and those asked for.
std::vector<bench::Candidate> chosen(const Options& options) {
  const auto all = bench::candidates();
  for (const std::string& key : options.only)
    if (std::none_of(all.begin(), all.end(), [&](const auto& c) { return c.key == key; }))
      throw app::UsageError("--only " + key + ": unknown; see bench_detection list");
  std::vector<bench::Candidate> some{all.front()};
  for (const bench::Candidate& c : all.subspan(1))
    if (options.only.empty() || std::find(options.only.begin(), options.only.end(), c.key) != options.only.end())
      some.push_back(c);
  return some;
}

void run(const Options& options) {
  const auto candidates = chosen(options);
  const bool recorded = options.from.size() == 1 && is_directory(options.from.front());
  if (recorded && options.rest) throw app::UsageError("--rest: is for mesh files; recorded states know their rest");
  const auto states =
      recorded ? bench::load_states(options.from.front()) : std::vector{bench::read_meshes(options.from, options.rest)};
  if (!recorded && options.tolerances.empty())
    throw app::UsageError("--tolerance: is needed for mesh files, in metres");
  const std::vector<float> tolerances = options.tolerances.empty() ? std::vector{0.25f, 0.5f} : options.tolerances;
  std::vector<bench::Measured> all;
  for (const bench::State& state : states) {
    if (options.bodies > 0 && state.bodies.count() != collide::Index(options.bodies)) continue;
    for (const float tolerance : tolerances) {
      all.push_back(bench::measure({&state, tolerance, options.threads, options.repeat}, candidates));
      if (!options.json && !options.csv) bench::print_table(all.back());
    }
  }
  if (all.empty()) fail_for_bodies(options);
  if (options.json) bench::print_json(all);
  if (options.csv) bench::print_csv(all);
}

void list() {
  for (const bench::Candidate& c : bench::candidates())
    std::printf("%s\t%s\n", std::string(c.key).c_str(), std::string(c.name).c_str());
}

/// Exit status: 0, or 1 if a candidate finds another set of contacts.
int parse_and_run(int argc, char** argv) {
  Options options;
  CLI::App cli{"Times exact detection beside libraries, on the same recorded states.", "bench_detection"};
  cli.require_subcommand(1);
  CLI::App* record_command = cli.add_subcommand("record", "simulate the piles and write them to a folder");
  CLI::App* run_command = cli.add_subcommand(
      "run", "compare the contacts, then the times, on the states of a folder or on your own meshes");
  CLI::App* list_command = cli.add_subcommand("list", "print the candidates, a line each: key, tab, name");
  for (CLI::App* command : {record_command, run_command}) {
    command->add_option("--threads", options.threads, "threads (default: 1)")->check(CLI::Range(1, 256));
    command->add_option("--bodies", options.bodies, "only states of so many bodies")->check(CLI::PositiveNumber);
  }
  record_command->add_option("DIR", options.folder, "folder of the states")->required();
  run_command->add_option("DIR|FILE", options.from, "folder of the states, or mesh files: consecutive frames")
      ->required();
  run_command->add_option("--rest", options.rest, "of files: their bodies at rest");
  run_command->add_option("--tolerance", options.tolerances, "in mean edges (default: 0.25 0.5); of files in metres")
      ->check(CLI::Range(1e-6, 1e6));
  run_command->add_option("--repeat", options.repeat, "rounds (default: 10)")->check(CLI::Range(1, 100'000));
  run_command->add_option("--only", options.only, "candidates, beside the first one (default: all)");
  CLI::Option* json = run_command->add_flag("--json", options.json, "print one JSON document instead of tables");
  run_command->add_flag("--csv", options.csv, "print one table as CSV instead")->excludes(json);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return cli.exit(asked);
  }
  if (*record_command) record(options);
  if (*run_command) run(options);
  if (*list_command) list();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const bench::Difference& difference) {
    std::fprintf(stderr, "bench_detection: %s\n", difference.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_detection: %s\n", error.what());
    return 2;
  }
}
