#include "app/session/export/frame_writers.h"

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/base/usage_error.h"
#include "app/files/output_file.h"

namespace app::session {
namespace fs = std::filesystem;
namespace {

fs::path new_folder(const fs::path& parent, const std::string& prefix) {
  fs::path folder = files::next_free_path(parent, prefix, "");
  files::prepare_folder(folder, "");
  return folder;
}

class PictureWriter : public FrameWriter {
 public:
  explicit PictureWriter(const fs::path& parent) : folder_(new_folder(parent, "pictures")) {}
  void write(const ExportedFrame& frame) override {
    files::write_file(folder_ / fmt::format("picture_{:05}.png", ++count_), engine::encode_png(frame.picture));
  }
  std::string name() const override { return folder_.string(); }

 private:
  fs::path folder_;
  int count_ = 0;  // not the world's frame, which a reset sets to 0
};

/// Starts a new folder whenever the bodies change, because `detect` requires the same bodies in all files.
class MotionWriter : public FrameWriter {
 public:
  explicit MotionWriter(fs::path parent) : parent_(std::move(parent)), folder_(new_folder(parent_, "motion")) {}
  void write(const ExportedFrame& frame) override {
    if (!files::ObjWriter::can_write(frame.positions))
      throw UsageError(fmt::format("frame {}: a body is no longer finite, so that no file can hold it", frame.number));
    if (frame.bodies != bodies_) {
      if (bodies_) folder_ = new_folder(parent_, "motion");
      bodies_ = frame.bodies;
      files::write_file(folder_ / files::rest_shape_name, bodies_->at_rest());
      bodies_->write_surroundings(folder_);
    }
    files::write_file(folder_ / fmt::format("frame_{:05}.obj", frame.number), frame.bodies->frame(frame.positions));
  }
  std::string name() const override { return folder_.string(); }

 private:
  fs::path parent_, folder_;
  std::shared_ptr<const files::ObjWriter> bodies_;
};

}  // namespace

std::optional<RecordingProgress> RecordingTask::advance(const Question& frame, const Background<RecordingTask>&) {
  if (progress_.ended) return progress_;  // it has failed
  try {
    if (frame) {
      writer_->write(*frame);
      ++progress_.written;
    } else {
      writer_->finish();
      progress_.ended = true;
    }
  } catch (const std::exception& failure) {
    progress_.error = failure_text(failure);
    progress_.ended = true;
  }
  progress_.name = writer_->name();
  return progress_;
}

std::unique_ptr<FrameWriter> make_picture_writer(const fs::path& folder) {
  return std::make_unique<PictureWriter>(folder);
}
std::unique_ptr<FrameWriter> make_motion_writer(const fs::path& folder) {
  return std::make_unique<MotionWriter>(folder);
}

}  // namespace app::session
