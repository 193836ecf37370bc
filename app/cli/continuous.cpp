#include "app/cli/commands.h"

#include <array>
#include <charconv>
#include <iostream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/base/timings.h"
#include "app/files/motion_file.h"
#include "app/files/output_file.h"

namespace app::cli {
namespace {

using Json = nlohmann::ordered_json;
using collide::oracle::FeatureMeeting;

/// Numbers of pairs of features.
struct Counts {
  std::size_t own = 0, others = 0;  // of one surface; of two
  void add(bool of_one) { ++(of_one ? own : others); }
};

/// Of one kind of pairs.
struct KindCounts {
  const char *key, *name;
  Counts meetings{}, passages{};
};

struct Figures {
  std::array<KindCounts, 2> kinds{{{"vf", "vertex and face"}, {"ee", "edge and edge"}}};  // as in FeatureMeeting::Kind
  double ms = 0;
};

/// Returns a number with the fewest digits that identify it.
std::string shortest(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.begin(), text.end(), number).ptr};
}

/// Returns a line of the table of meetings.
std::string csv_line(const FeatureMeeting& meeting) {
  const auto& [a0, a1] = meeting.feature;
  const auto& [b0, b1, b2] = meeting.against;
  const std::string features = meeting.kind == FeatureMeeting::Kind::vertex_face
                                   ? fmt::format("vf,{},,{},{},{}", a0, b0, b1, b2)
                                   : fmt::format("ee,{},{},{},{},", a0, a1, b0, b1);
  return fmt::format("{},{},{},{:d}\n", features, shortest(meeting.first.low), shortest(meeting.first.high),
                     meeting.passes);
}

Figures find(const files::MotionFiles& motion, const Options& options) {
  std::optional<files::OutputFile> csv;
  if (options.detect.contacts) csv.emplace(*options.detect.contacts, "kind,a0,a1,b0,b1,b2,time_low,time_high,passes\n");
  Figures figures;
  collide::Workers workers(options.threads);
  const auto take = [&](const std::vector<FeatureMeeting>& meetings) {
    for (const FeatureMeeting& m : meetings) {
      const bool own = motion.mesh.body[m.feature[0]] == motion.mesh.body[m.against[0]];
      KindCounts& kind = figures.kinds[std::size_t(m.kind)];
      kind.meetings.add(own);
      if (m.passes) kind.passages.add(own);
      if (csv) csv->write(csv_line(m));
    }
  };
  figures.ms = time_ms([&] { collide::oracle::find_meetings(motion.mesh, workers, take); });
  if (csv) csv->commit();
  return figures;
}

Json to_json(const files::MotionFiles& motion, const Figures& figures, int threads) {
  Json document{{"threads", threads},
                {"surfaces", motion.bodies},
                {"vertices", motion.mesh.vertices.size()},
                {"edges", motion.mesh.edges.size()},
                {"faces", motion.mesh.faces.size()}};
  for (const auto& [name, counts] :
       {std::pair("meetings", &KindCounts::meetings), {"passages", &KindCounts::passages}}) {
    for (const KindCounts& kind : figures.kinds)
      document[name][kind.key] = {{"own", (kind.*counts).own}, {"others", (kind.*counts).others}};
  }
  document["ms"] = figures.ms;
  return document;
}

void print_table(const files::MotionFiles& motion, const Figures& figures, int threads) {
  std::cout << fmt::format("contact in motion, threads {}, surfaces {}, vertices {}, edges {}, faces {}, {:.3f} ms\n",
                           threads, motion.bodies, motion.mesh.vertices.size(), motion.mesh.edges.size(),
                           motion.mesh.faces.size(), figures.ms);
  std::cout << fmt::format("{:16} {:>12} {:>12} {:>12} {:>12}\n", "pairs of", "meet, own", "others", "pass, own",
                           "others");
  for (const KindCounts& kind : figures.kinds)
    std::cout << fmt::format("{:16} {:12} {:12} {:12} {:12}\n", kind.name, kind.meetings.own, kind.meetings.others,
                             kind.passages.own, kind.passages.others);
}

}  // namespace

void detect_continuous(const Options& options) {
  const std::vector<std::string>& files = options.detect.files;
  if (files.size() != 2) throw UsageError("--continuous: takes two files: detect FROM TO --continuous");
  const files::MotionFiles motion = files::read_motion(files[0], files[1]);
  const Figures figures = find(motion, options);
  if (options.json)
    std::cout << to_json(motion, figures, options.threads).dump() << '\n';
  else
    print_table(motion, figures, options.threads);
}

}  // namespace app::cli
