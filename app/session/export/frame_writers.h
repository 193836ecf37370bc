#pragma once
// What a recording can become. One table: the panel, the demo and the tests loop over it.

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "app/session/export/recording.h"

namespace app {

// Each makes its folder or starts its file, under the next free name in `folder`. They throw UsageError.
std::unique_ptr<FrameWriter> make_picture_writer(const std::filesystem::path& folder);
std::unique_ptr<FrameWriter> make_video_writer(const std::filesystem::path& folder);
std::unique_ptr<FrameWriter> make_motion_writer(const std::filesystem::path& folder);

struct RecordingKind {
  std::string_view key, name, tooltip;
  bool pictures;  // made of pictures, or else of bodies
  std::unique_ptr<FrameWriter> (*make)(const std::filesystem::path& folder);
};

inline constexpr std::array<RecordingKind, 3> recording_kinds{{
    {"video", "Video", "An MP4 file, 60 pictures a second, by ffmpeg.", true, &make_video_writer},
    {"pictures", "Pictures", "A folder of PNG files, one a frame of the world.", true, &make_picture_writer},
    {"motion", "Motion (OBJ)",
     "A folder of OBJ files, one a frame of the world, each body an object; `sbcollide detect` reads them back.", false,
     &make_motion_writer},
}};

}  // namespace app
