#include "app/session/export/frame_writers.h"

#include <fmt/core.h>

#include "app/files/output_file.h"

namespace app {
namespace fs = std::filesystem;
namespace {

fs::path new_folder(const fs::path& parent, const std::string& prefix) {
  fs::path folder = next_free(parent, prefix, "");
  prepare_folder(folder, "");
  return folder;
}

class PictureWriter : public FrameWriter {
 public:
  explicit PictureWriter(const fs::path& parent) : folder_(new_folder(parent, "pictures")) {}
  void write(const RecordedFrame& frame) override {
    write_file(folder_ / fmt::format("picture_{:05}.png", ++count_), engine::encode_png(frame.picture));
  }
  std::string name() const override { return folder_.string(); }

 private:
  fs::path folder_;
  int count_ = 0;  // not the world's frame, which a reset sets back
};

/// `detect` wants the same bodies in all files, so that whenever they change a new folder is begun.
class MotionWriter : public FrameWriter {
 public:
  explicit MotionWriter(fs::path parent) : parent_(std::move(parent)), folder_(new_folder(parent_, "motion")) {}
  void write(const RecordedFrame& frame) override {
    if (frame.bodies != bodies_) begin(frame);
    const Positions& p = frame.positions;
    write_file(folder_ / fmt::format("frame_{:05}.obj", frame.number), frame.bodies->frame(p.x, p.y, p.z));
  }
  std::string name() const override { return folder_.string(); }

 private:
  void begin(const RecordedFrame& frame) {
    if (bodies_) folder_ = new_folder(parent_, "motion");
    bodies_ = frame.bodies;
    write_file(folder_ / "rest.obj", bodies_->at_rest());
  }

  fs::path parent_, folder_;
  std::shared_ptr<const MovingBodies> bodies_;
};

}  // namespace

std::unique_ptr<FrameWriter> make_picture_writer(const fs::path& folder) {
  return std::make_unique<PictureWriter>(folder);
}
std::unique_ptr<FrameWriter> make_motion_writer(const fs::path& folder) {
  return std::make_unique<MotionWriter>(folder);
}

}  // namespace app
