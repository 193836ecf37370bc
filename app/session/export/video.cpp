// Writes a video by ffmpeg, another program, which reads the pictures from a pipe.

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include <fmt/core.h>

#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/session/export/frame_writers.h"

namespace app::session {
namespace fs = std::filesystem;
namespace {

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
    if (std::fwrite(picture.rgba.data(), 1, picture.rgba.size(), ffmpeg_.get()) != picture.rgba.size())
      fail(::pclose(ffmpeg_.release()));
  }
  void finish() override {
    if (!ffmpeg_) return;  // there was no frame
    if (const int status = ::pclose(ffmpeg_.release()); status != 0) fail(status);
    output_->commit();
  }
  std::string name() const override { return file_.string(); }

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

  void begin(const engine::Image& picture) {
    width_ = picture.width;
    height_ = picture.height;
    output_.emplace(file_);
    errors_.reset(std::tmpfile());
    // The codec requires even sides. The output has no name, so that ffmpeg cannot make it again after a signal has
    // removed it.
    if (errors_)
      ffmpeg_.reset(::popen(fmt::format("exec ffmpeg -nostdin -y -loglevel error -f rawvideo -pix_fmt rgba -s {}x{} "
                                        "-r 60 -i pipe:0 -vf 'crop=trunc(iw/2)*2:trunc(ih/2)*2' -pix_fmt yuv420p -f "
                                        "mp4 /dev/stdout >/proc/{}/fd/{} 2>/dev/fd/{}",
                                        width_, height_, ::getpid(), output_->descriptor(), ::fileno(errors_.get()))
                                .c_str(),
                            "we"));
    if (!ffmpeg_) throw UsageError(std::string("ffmpeg cannot be started: ") + std::strerror(errno));
  }
  /// status: of pclose().
  [[noreturn]] void fail(int status) {
    constexpr int not_found = 127;  // as the shell says it
    if (WIFEXITED(status) && WEXITSTATUS(status) == not_found)
      throw UsageError(
          "a video needs ffmpeg, which is not there: install it (apt-get install ffmpeg), or record pictures");
    std::string last = "it does not say why";
    for (std::array<char, 4096> line; std::fgets(line.data(), int(line.size()), errors_.get());)
      last = std::string(line.data(), std::strcspn(line.data(), "\n"));
    throw UsageError(file_.string() + ": ffmpeg has failed: " + last);
  }

  fs::path file_;
  int width_ = 0, height_ = 0;
  std::optional<files::OutputFile> output_;
  File errors_{nullptr, &std::fclose};  // what ffmpeg says
  File ffmpeg_{nullptr, &::pclose};     // last: it ends first
};

}  // namespace

std::unique_ptr<FrameWriter> make_video_writer(const fs::path& folder) { return std::make_unique<VideoWriter>(folder); }

}  // namespace app::session
