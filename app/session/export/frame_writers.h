#pragma once
// The kinds of recordings. The panel, the demo and the tests loop over one table.

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "app/session/export/recording_task.h"

namespace app::session {

/// Make a writer whose folder or file has the next free name in `folder`. They throw UsageError.
std::unique_ptr<FrameWriter> make_picture_writer(const std::filesystem::path& folder);
std::unique_ptr<FrameWriter> make_video_writer(const std::filesystem::path& folder);
std::unique_ptr<FrameWriter> make_motion_writer(const std::filesystem::path& folder);

struct RecordingKind {
  std::string_view key, name, tooltip;
  bool pictures;  // consists of pictures, else of bodies
  std::unique_ptr<FrameWriter> (*make)(const std::filesystem::path& folder);
};

inline constexpr std::array<RecordingKind, 3> recording_kinds{{
    {"video", "Video", "An MP4 file, 60 pictures a second, by ffmpeg.", true, &make_video_writer},
    {"pictures", "Pictures", "A folder of PNG files, one a frame of the world.", true, &make_picture_writer},
    {"motion", "Motion (OBJ)",
     "A folder of OBJ files, one a frame of the world, each body an object; `sbcollide detect` reads them back.", false,
     &make_motion_writer},
}};

}  // namespace app::session
