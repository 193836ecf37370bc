#include "app/session/export/recording.h"

namespace app::session {

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
    progress_.error = failure.what();
    progress_.ended = true;
  }
  progress_.name = writer_->name();
  return progress_;
}

void FrameRecording::stop(std::string error) {
  if (!error.empty()) progress_.error = std::move(error);
  if (!std::exchange(progress_.stopping, true)) task_.offer(std::nullopt);
}

const RecordingProgress& FrameRecording::update() {
  if (std::optional<RecordingProgress> now = task_.take()) {
    now->stopping = progress_.stopping;
    if (now->error.empty()) now->error = progress_.error;
    progress_ = std::move(*now);
  }
  return progress_;
}

}  // namespace app::session
