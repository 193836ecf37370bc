#include "app/session/export/recording_task.h"

#include "app/base/text.h"

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
    progress_.error = failure_text(failure);
    progress_.ended = true;
  }
  progress_.name = writer_->name();
  return progress_;
}

}  // namespace app::session
