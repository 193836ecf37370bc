#pragma once
// `report`: measurements that take minutes and leave files behind.

#include <filesystem>
#include <optional>
#include <string>

namespace app {

struct ReportOptions {
  std::string name;                  // which report
  std::optional<std::string> scene;  // only this one
  bool quick = false;                // within a minute: less of everything
  std::optional<int> threads;        // detection: of the detectors that are timed; else: runs side by side
  int cores = 1;                     // threads for all that is not timed
  std::filesystem::path out = ".";   // folder of the files
};

/// Makes a report. Throws UsageError before anything runs if there is no such report or the folder cannot be written
/// to; and SceneError.
void report(const ReportOptions& options);

}  // namespace app
