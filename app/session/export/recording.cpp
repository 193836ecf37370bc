#include "app/session/export/recording.h"

#include <utility>

namespace app::session {

FrameRecording::FrameRecording(std::unique_ptr<FrameWriter> writer) : writer_(std::move(writer)) {
  progress_.name = writer_->name();
  thread_ = std::jthread([this] { work(); });
}

bool FrameRecording::has_room() const {
  const std::scoped_lock lock(mutex_);
  return waiting_.size() < max_waiting;
}

void FrameRecording::add(RecordedFrame frame) {
  {
    const std::scoped_lock lock(mutex_);
    if (progress_.stopping || progress_.ended) return;
    waiting_.push_back(std::move(frame));
  }
  wake_.notify_one();
}

void FrameRecording::stop(std::string error) {
  {
    const std::scoped_lock lock(mutex_);
    progress_.stopping = true;
    if (!error.empty()) progress_.error = std::move(error);
  }
  wake_.notify_one();
}

FrameRecording::Progress FrameRecording::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

/// Waits for a frame; returns false after the last one.
bool FrameRecording::next(RecordedFrame& frame) {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return progress_.stopping || !waiting_.empty(); });
  if (waiting_.empty()) return false;
  frame = std::move(waiting_.front());
  waiting_.pop_front();
  return true;
}

void FrameRecording::work() {
  std::string error;
  try {
    for (RecordedFrame frame; next(frame);) {
      writer_->write(frame);
      const std::scoped_lock lock(mutex_);
      ++progress_.written;
      progress_.name = writer_->name();
    }
    writer_->finish();
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  const std::scoped_lock lock(mutex_);
  if (!error.empty()) progress_.error = error;
  progress_.ended = true;
  waiting_.clear();
}

}  // namespace app::session
