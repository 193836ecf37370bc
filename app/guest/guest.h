#pragma once
// Methods of the user's own, written in C or C++ against sbcollide/method.h: each a source that is compiled, or a
// library. A guest runs in a process of its own, so that a wrong one harms nothing.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "app/base/process.h"
#include "collide/methods.h"

namespace app::guest {

/// Is to be called first in main(). Does not return if this process is to be a guest's.
void run_if_guest(int count, char** arguments);

/// Returns true for the name of a source or a library.
bool is_guest(const std::filesystem::path& file);

/// What a file has become.
struct Build {
  std::shared_ptr<const SharedMemory> library;
  std::string problem;  // why there is no guest in it, in one line that names the file; else empty
  std::string errors;   // of the compiler, all lines; else empty
  std::string name, summary;
};

/// A file with a method, in a shared_ptr. Its members may be called from any thread.
class Guest : public std::enable_shared_from_this<Guest> {
 public:
  /// Throws UsageError unless is_guest(file). Loads nothing.
  explicit Guest(std::filesystem::path file);

  const std::filesystem::path& file() const { return file_; }
  /// Returns true if the file is not as it was at the last load(), or was not loaded yet.
  bool changed() const { return stamp() != loaded_stamp_; }
  /// Compiles the file if it is a source, and loads it. The first method that is found in it joins the table of
  /// methods, with the key "guest:KEY", and a number behind it if it is taken. Takes seconds. Throws nothing.
  void load();
  /// Gives its row the name and the summary of the latest build. Nobody else may read the table's texts meanwhile.
  void rename() const;
  /// Returns the latest build; null before the first load().
  std::shared_ptr<const Build> build() const;
  /// Returns its row in the table of methods; nullptr before it has one.
  const collide::Method* method() const { return method_; }

  /// Gives up what its processes do, now and from now on.
  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }

 private:
  std::int64_t stamp() const;
  std::string description(const Build& build) const;
  void add_row(const std::string& own_key, const Build& build);

  std::filesystem::path file_;
  std::atomic<const collide::Method*> method_ = nullptr;
  std::atomic<bool> stopped_ = false;
  std::atomic<std::int64_t> loaded_stamp_ = -1;  // none
  mutable std::mutex mutex_;                     // guards the member below
  std::shared_ptr<const Build> build_;
};

/// Returns a detector that asks the guest.
std::unique_ptr<collide::Detector> make_detector(std::shared_ptr<const Guest> guest);

/// Loads a file. Throws UsageError if there is no method in it; errors of the compiler are then on standard error.
std::shared_ptr<Guest> open(const std::filesystem::path& file);

}  // namespace app::guest
