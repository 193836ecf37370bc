#pragma once
// The contacts of `detect` as a table of comma-separated values.

#include "app/files/output_file.h"
#include "collide/core/detector.h"

namespace app::files {

class ContactsCsv {
 public:
  /// Throws UsageError if the file cannot be written, as do all members. Replaces only an empty file or an earlier
  /// table of contacts: if the user forgets the name after --contacts, the next mesh would be taken for it.
  explicit ContactsCsv(const std::filesystem::path& path);

  /// Adds a line for each contact of frame `number`. file_vertex: by vertex, its number in the file, which the table
  /// has; its lines are in ascending order of these numbers.
  void add(std::size_t number, const collide::Frame& frame, std::span<const collide::Index> file_vertex,
           const std::vector<collide::Contact>& contacts);
  /// Puts the finished file into its place. Without this call there is no file.
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
};

}  // namespace app::files
