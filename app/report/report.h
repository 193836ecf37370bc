#pragma once
// `report`: measurements that take minutes and leave files behind.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/files/body_file.h"

namespace app::report {

struct ReportOptions {
  std::string name;                  // which report
  std::optional<std::string> scene;  // only this one
  // detection: the frames of a recorded sequence, in place of scenes
  std::vector<std::string> files;
  std::optional<double> tolerance;    // m, of the sequence
  std::optional<files::BodiesBy> by;  // what a body of the sequence is; otherwise the format's default
  std::optional<std::string> rest;    // the bodies of the sequence at rest
  bool quick = false;                 // within a minute: less of everything
  std::optional<int> threads;         // detection: of the detectors that are timed; else: runs side by side
  int cores = 1;                      // threads for all that is not timed
  std::filesystem::path out = ".";    // folder of the files
};

/// Makes the report that `options.name` names. Throws UsageError before anything runs if there is no such report or the
/// folder cannot be written to; and SceneError.
void report(const ReportOptions& options);

// The reports. Each writes NAME.csv, a page and plots into options.out, after it has measured everything.
/// What each detector costs, and what it misses.
void report_detection(const ReportOptions& options);
/// How accurate each kind of contact is, judged by the surface oracle, and what it costs.
void report_contact(const ReportOptions& options);
/// What each integrator's error is, and what it costs.
void report_solver(const ReportOptions& options);
/// What each integrator survives.
void report_stability(const ReportOptions& options);

}  // namespace app::report
