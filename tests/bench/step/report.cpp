#include "tests/bench/step/report.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numeric>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/base/table.h"

#include "tests/bench/median.h"

namespace bench {
namespace {

using Json = nlohmann::ordered_json;

struct Summary {
  double mean, median, worst;  // ms
};

Summary summary(std::span<const double> times) {
  return {std::accumulate(times.begin(), times.end(), 0.0) / double(times.size()), median({times.begin(), times.end()}),
          *std::ranges::max_element(times)};
}

struct Ratio {
  double mean = 0, worst = 0;
};

/// Of the processor times; nothing for what was given up, whose few frames tell nothing.
std::optional<Ratio> ratio(const Track& track, const Track& own) {
  if (track.figures.lost > 0 || own.figures.lost > 0) return {};
  const Summary a = summary(track.times.cpu), b = summary(own.times.cpu);
  return Ratio{a.mean / b.mean, a.worst / b.worst};
}

std::string in_words(const Figures& figures) {
  std::string text;
  for (const std::string& failure : failures(figures)) text.append(text.empty() ? "" : "; ").append(failure);
  return text.empty() ? "stable" : text;
}

Json to_json(const Times& times) {
  const auto one = [](const std::vector<double>& ms) {
    const Summary s = summary(ms);
    return Json{{"mean", s.mean}, {"median", s.median}, {"worst", s.worst}, {"frames", ms}};
  };
  return {{"cpu", one(times.cpu)}, {"wall", one(times.wall)}};
}

Json to_json(const std::optional<Ratio>& ratio) {
  if (!ratio) return nullptr;
  return {{"mean", ratio->mean}, {"worst", ratio->worst}};
}

Json to_json(const Track& t, const Result& r) {
  const Figures& f = t.figures;
  return {{"key", t.entrant->key},
          {"ms", to_json(t.times)},
          {"ratio", {{"vertex-vertex", to_json(ratio(t, r.tracks[0]))}, {"surface", to_json(ratio(t, r.tracks[1]))}}},
          {"finite", f.finite},
          {"energy", f.energy},
          {"volume", {{"min", f.volume_min}, {"max", f.volume_max}}},
          {"deepest", {{"solid", f.solid}, {"body", f.inside}}},
          {"vertices_inside", f.vertices_inside},
          {"speed", f.speed},
          {"lost", f.lost},
          {"failures", failures(f)}};
}

}  // namespace

void print_table(const Result& r) {
  std::printf(
      "47 bodies, 1e4 N/m, gas: %s; %d frames. Processor ms for 1/60 s, and as multiples of the first two rows\n",
      std::string(r.course.gas->what).c_str(), r.course.frames);
  std::printf("  %-38s %8s %8s %8s %15s %15s\n", "", "mean", "median", "worst", "mean, times", "worst, times");
  for (const Track& t : r.tracks) {
    const Summary s = summary(t.times.cpu);
    std::printf("  %-38.*s %8.3f %8.3f %8.3f", int(t.entrant->name.size()), t.entrant->name.data(), s.mean, s.median,
                s.worst);
    const auto vertex = ratio(t, r.tracks[0]), surface = ratio(t, r.tracks[1]);
    if (vertex && surface)
      std::printf(" %7.2f %7.2f %7.2f %7.2f", vertex->mean, surface->mean, vertex->worst, surface->worst);
    std::printf("\n");
  }
  std::printf("  %-38s %8s %15s %8s %8s %8s %8s\n", "", "energy", "volume", "solid/R", "inside/R", "vertices", "m/s");
  for (const Track& t : r.tracks) {
    const Figures& f = t.figures;
    std::printf("  %-38.*s %8.3g %7.3f %7.3g %8.3f %8.3f %8zu %8.3g  %s\n", int(t.entrant->name.size()),
                t.entrant->name.data(), f.energy, f.volume_min, f.volume_max, f.solid, f.inside, f.vertices_inside,
                f.speed, in_words(f).c_str());
  }
  std::fflush(stdout);
}

void print_csv(const std::vector<Result>& all) {
  app::Table table;
  for (const Result& r : all)
    for (const Track& t : r.tracks) {
      const Summary s = summary(t.times.cpu);
      const auto beside = ratio(t, r.tracks[1]);
      table.add({{"contact", t.entrant->key},
                 {"gas", r.course.gas->key},
                 {"verdict", in_words(t.figures)},
                 {"mean", app::brief(s.mean)},
                 {"median", app::brief(s.median)},
                 {"worst", app::brief(s.worst)},
                 {"mean over surface's", app::when(beside.has_value(), app::brief(beside.value_or(Ratio{}).mean))},
                 {"worst over surface's", app::when(beside.has_value(), app::brief(beside.value_or(Ratio{}).worst))},
                 {"deepest in a body, R", app::brief(t.figures.inside, 2)},
                 {"vertices inside", t.figures.vertices_inside}});
    }
  std::cout << table.csv();
}

void print_json(const std::vector<Result>& all) {
  Json runs = Json::array();
  for (const Result& r : all) {
    Json rows = Json::array();
    for (const Track& t : r.tracks) rows.push_back(to_json(t, r));
    runs.push_back({{"gas", r.course.gas->key},
                    {"pressure", r.course.gas->pressure},
                    {"ambient", r.course.gas->ambient},
                    {"frames", r.course.frames},
                    {"repeat", r.course.repeat},
                    {"entrants", rows}});
  }
  std::cout << Json{{"runs", runs}}.dump() << '\n';
}

}  // namespace bench
