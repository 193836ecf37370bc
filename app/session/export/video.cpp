// Writes a video by ffmpeg, a child process that reads the pictures.

#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "app/base/process.h"
#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/session/export/frame_writers.h"

namespace app::session {
namespace fs = std::filesystem;
namespace {

/// video: the file to write. Throws UsageError if there is no ffmpeg.
std::unique_ptr<Process> start_ffmpeg(std::vector<std::string> words, int video) {
  try {
    return std::make_unique<Process>(std::move(words), video);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory)
      throw UsageError(
          "a video needs ffmpeg, which is not there: install it (apt-get install ffmpeg), or record pictures");
    throw UsageError("ffmpeg cannot be started: " + error.code().message());
  }
}

class VideoWriter : public FrameWriter {
 public:
  explicit VideoWriter(const fs::path& folder) : file_(files::next_free_path(folder, "video", ".mp4")) {
    files::prepare_folder(folder, "");
  }

  void write(const ExportedFrame& frame) override {
    const engine::Image& picture = frame.picture;
    if (!ffmpeg_) begin(picture);
    if (picture.width != width_ || picture.height != height_) {
      finish();
      throw UsageError("the size of the picture has changed, and a video has but one: it ends there, " + name());
    }
    if (!ffmpeg_->send(std::as_bytes(std::span(picture.rgba)))) {
      ffmpeg_->finish();
      fail();
    }
  }

  void finish() override {
    if (!ffmpeg_) return;  // there was no frame
    if (!ffmpeg_->finish()) fail();
    ffmpeg_.reset();
    output_->commit();
  }

  std::string name() const override { return file_.string(); }

 private:
  void begin(const engine::Image& picture) {
    width_ = picture.width;
    height_ = picture.height;
    // The codec requires even sides. The output has no name, so that ffmpeg cannot make it again after a signal has
    // removed it.
    std::istringstream words(
        fmt::format("ffmpeg -nostdin -y -loglevel error -f rawvideo -pix_fmt rgba -s {}x{} -r 60 -i pipe:0 "
                    "-vf crop=trunc(iw/2)*2:trunc(ih/2)*2 -pix_fmt yuv420p -f mp4 /dev/stdout",
                    width_, height_));
    output_.emplace(file_);
    ffmpeg_ = start_ffmpeg({std::istream_iterator<std::string>(words), {}}, output_->descriptor());
  }

  [[noreturn]] void fail() {
    std::string why = ffmpeg_->errors();
    while (why.ends_with('\n')) why.pop_back();
    why.erase(0, why.rfind('\n') + 1);
    throw UsageError(file_.string() + ": ffmpeg has failed: " + (why.empty() ? "it does not say why" : why));
  }

  fs::path file_;
  int width_ = 0, height_ = 0;
  std::optional<files::OutputFile> output_;
  std::unique_ptr<Process> ffmpeg_;  // after output_, because it ends first
};

}  // namespace

std::unique_ptr<FrameWriter> make_video_writer(const fs::path& folder) { return std::make_unique<VideoWriter>(folder); }

}  // namespace app::session
