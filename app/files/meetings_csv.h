#pragma once
// The meetings of `detect --continuous` as a table of comma-separated values.

#include "app/files/output_file.h"
#include "collide/oracle/moving_mesh.h"

namespace app::files {

class MeetingsCsv {
 public:
  /// Throws UsageError if the file cannot be written, as do all members. Replaces only an empty file or an earlier
  /// table of meetings.
  explicit MeetingsCsv(const std::filesystem::path& path);

  void add(const collide::oracle::FeatureMeeting& meeting);
  /// Puts the finished file into its place. Without this call there is no file.
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
};

}  // namespace app::files
