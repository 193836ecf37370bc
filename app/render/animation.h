#pragma once
// Writes pictures as an animated image.

#include <filesystem>
#include <memory>
#include <string>

#include "app/files/output_file.h"
#include "engine/image.h"

struct WebPMux;

namespace app::render {

/// An animated WebP file that repeats forever. Until it is written, its pictures stay in memory, compressed.
class Animation {
 public:
  /// Throws UsageError, as do all members, e.g. if the file cannot be written, or if it exists and is no WebP file.
  explicit Animation(std::filesystem::path file);

  /// Adds a picture, at most 16,383 pixels wide and high and as large as the first one. `start` (s): the time at which
  /// it appears, which increases from picture to picture.
  void add(engine::Image picture, double start);
  /// Writes the file. The last picture disappears at `end` (s). This must be the last call, after add(). Without it no
  /// new file remains, and an older one stays.
  void write(double end);

 private:
  /// A compressed part of a picture, to be drawn over the pictures before it.
  struct Update {
    std::string bytes;
    int left = 0, top = 0;  // pixels
    double start = 0;       // s
  };
  void finish_update(double end);
  void require(bool done) const;

  std::filesystem::path file_;
  files::OutputFile out_;
  std::unique_ptr<WebPMux, void (*)(WebPMux*)> mux_;
  engine::Image latest_;
  Update update_;  // to latest_; not in mux_ yet, which wants to know how long it is shown
};

}  // namespace app::render
