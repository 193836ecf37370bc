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

}  // namespace app::session
