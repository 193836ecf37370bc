#pragma once
// `report`: measurements that take minutes and leave files behind.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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

/// Returns the names of all reports, with ", " between two and `before_last` before the last.
std::string report_names(std::string_view before_last = ", ");

}  // namespace app::report
