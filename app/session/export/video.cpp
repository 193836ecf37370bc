// Writes a video by ffmpeg, a child process that reads the pictures.

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/session/export/frame_writers.h"

extern char** environ;

namespace app::session {
namespace fs = std::filesystem;
namespace {

constexpr int timeout_seconds = 30;  // for one picture, and for the end

/// Owns a file descriptor and closes it.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  int number() const { return number_; }

 private:
  int number_;
};

/// A running ffmpeg. It reads from a socket, not a pipe: when ffmpeg dies, sending fails, and no signal ends the
/// program.
class Ffmpeg {
 public:
  /// video: the file to write, which becomes ffmpeg's standard output. Throws UsageError if there is no ffmpeg.
  Ffmpeg(std::vector<std::string> arguments, int video) {
    std::array<int, 2> pictures{}, errors{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pictures.data()) != 0) refuse(errno);
    const FileDescriptor input(pictures[1]);
    pictures_ = FileDescriptor(pictures[0]);
    if (::pipe2(errors.data(), O_CLOEXEC) != 0) refuse(errno);
    const FileDescriptor output(errors[1]);
    errors_ = FileDescriptor(errors[0]);
    const timeval limit{timeout_seconds, 0};
    ::setsockopt(pictures[0], SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    if (const int error = spawn(std::move(arguments), input.number(), video, output.number())) refuse(error);
  }
  ~Ffmpeg() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  /// Returns false if ffmpeg reads no more.
  bool send(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const auto sent = ::send(pictures_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// Ends the pictures and waits for ffmpeg. Returns true if ffmpeg reports success. Call it once.
  bool finish() {
    pictures_ = FileDescriptor();
    if (child_ <= 0) return false;
    int status = 0;
    for (int tenth = 0; tenth < 10 * timeout_seconds; ++tenth) {
      if (::waitpid(child_, &status, WNOHANG) == child_) {
        child_ = 0;
        return WIFEXITED(status) && WEXITSTATUS(status) == 0;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }

  /// Returns the last line that ffmpeg wrote to standard error. Call it after finish().
  std::string last_error_line() const {
    std::string text(4096, '\0');
    ::fcntl(errors_.number(), F_SETFL, O_NONBLOCK);
    const auto length = ::read(errors_.number(), text.data(), text.size());
    text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    text.erase(0, text.rfind('\n') + 1);
    return text.empty() ? "it does not say why" : text;
  }

 private:
  [[noreturn]] static void refuse(int error) {
    if (error == ENOENT)
      throw UsageError(
          "a video needs ffmpeg, which is not there: install it (apt-get install ffmpeg), or record pictures");
    throw UsageError(std::string("ffmpeg cannot be started: ") + std::strerror(error));
  }

  int spawn(std::vector<std::string> arguments, int input, int output, int errors) {
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    std::vector<char*> argv;
    for (std::string& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int error = ::posix_spawnp(&child_, argv[0], &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return error;
  }

  FileDescriptor pictures_, errors_;
  pid_t child_ = 0;
};

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
    if (!ffmpeg_->send(picture.rgba)) {
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
    ffmpeg_ = std::make_unique<Ffmpeg>(std::vector<std::string>{std::istream_iterator<std::string>(words), {}},
                                       output_->descriptor());
  }

  [[noreturn]] void fail() { throw UsageError(file_.string() + ": ffmpeg has failed: " + ffmpeg_->last_error_line()); }

  fs::path file_;
  int width_ = 0, height_ = 0;
  std::optional<files::OutputFile> output_;
  std::unique_ptr<Ffmpeg> ffmpeg_;  // after output_, because it ends first
};

}  // namespace

std::unique_ptr<FrameWriter> make_video_writer(const fs::path& folder) { return std::make_unique<VideoWriter>(folder); }

}  // namespace app::session
