#pragma once
// The contacts of `detect` as a table of comma-separated values.

#include "app/files/output_file.h"
#include "collide/core/detector.h"

namespace app {

class ContactsCsv {
 public:
  /// Throws UsageError, as all of this class does, if the file cannot be written. It replaces only an empty file and
  /// another table of contacts, since a name that was left out after --contacts makes a mesh the file to write.
  explicit ContactsCsv(const std::filesystem::path& path);

  /// Adds the contacts of a frame, a line each, in their order.
  void add(std::size_t number, const collide::Frame& frame, const std::vector<collide::Contact>& contacts);
  /// Puts the file into its place; without it there is none.
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
};

}  // namespace app
