#pragma once
// A recording of balls that move along x, of which the last one joins late.

#include <fmt/core.h>

#include "app/files/playback.h"
#include "softbody/mesh/mesh.h"
#include "tests/temporary_folder.h"

namespace app {

/// Its frames are read from their files whenever they are shown.
class RecordedBalls : private tests::TemporaryFolder, public files::Playback {
 public:
  static constexpr std::uint32_t few = 2, all = 3;  // bodies, before and from frame `late` on
  static constexpr int late = 4;

  explicit RecordedBalls(int frames, double radius = 0.5)
      : files::Playback(written(*this, frames, radius), {}, 0, true) {}

  std::filesystem::path file(int number) const { return path() / fmt::format("ball {}.obj", number); }

 private:
  static std::vector<std::filesystem::path> written(const RecordedBalls& balls, int frames, double radius) {
    const softbody::Mesh mesh = softbody::icosphere(1, radius);
    std::vector<std::filesystem::path> files;
    for (int number = 0; number < frames; ++number) {
      std::string text;
      for (std::uint32_t body = 0; body < (number < late ? few : all); ++body) {
        const std::size_t first = 1 + body * mesh.vertices.size();
        text += "o ball\n";
        for (const glm::dvec3& v : mesh.vertices)
          text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", v.x + (1.3 - 0.05 * number) * body, v.y + 0.01 * number, v.z);
        for (const auto& [a, b, c] : mesh.triangles)
          text += fmt::format("f {} {} {}\n", first + a, first + b, first + c);
      }
      files.push_back(balls.write(balls.file(number).filename().string(), text));
    }
    return files;
  }
};

/// Returns a recording with a scene to play it in.
inline files::Opened opened(std::shared_ptr<files::Playback> recording) {
  softbody::Scene scene;
  scene.key = scene.name = "balls";
  scene.collision.tolerance = 0.15f;
  return {std::move(scene), std::move(recording)};
}

}  // namespace app
