#include "app/session/export/exporter.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include <fmt/core.h>

#include "app/base/table.h"
#include "app/files/output_file.h"
#include "app/session/system_files.h"

namespace app::session {
namespace fs = std::filesystem;
namespace {

struct Curve {
  std::string name;
  const TimeSeries& series;
};

std::vector<Curve> curves_of(const Simulation& simulation, const LiveComparison& comparison) {
  const StepHistory& history = simulation.history;
  std::vector<Curve> curves{{"frame_ms", history.frame_ms},
                            {"detect_ms", history.detect_ms},
                            {"solve_ms", history.solve_ms},
                            {"contacts", history.contacts},
                            {"recall", comparison.recall()}};
  for (std::size_t i = 0; i < stability_quantities.size(); ++i)
    curves.push_back({stability_quantities[i].column, simulation.stability().history()[i]});
  for (std::size_t i = 0; i < comparison.method_ms().size(); ++i)
    curves.push_back({collide::method_table()[i].key + "_ms", comparison.method_ms()[i]});
  return curves;
}

/// Returns the absolute path of a folder that the user names.
fs::path absolute_folder(const std::string& folder) {
  return fs::absolute(folder.empty() ? "." : folder).lexically_normal();
}

}  // namespace

std::string curves_csv(const Simulation& simulation, const LiveComparison& comparison) {
  std::vector<std::string> columns{"frame"};
  std::map<int, TableRow> rows;
  for (const auto& [name, series] : curves_of(simulation, comparison)) {
    columns.push_back(name);
    for (std::size_t i = 0; i < series.size(); ++i) {
      TableRow& row = rows.try_emplace(series.frame(i), TableRow{{"frame", series.frame(i)}}).first->second;
      // A frame may have several values, if the world was paused or went back. The last one counts.
      if (row.back().column == name) row.pop_back();
      row.push_back({name, series[i]});
    }
  }
  Table table(std::move(columns));
  for (const auto& [frame, row] : rows) table.add(row);
  return table.csv();
}

Exporter::~Exporter() {
  if (recording()) stop();
  if (recording_) recording_->wait();
}

/// Runs an action. Its result, or its error, becomes the message.
void Exporter::attempt(const std::function<std::string()>& action) {
  try {
    message_ = action();
    failed_ = false;
  } catch (const std::exception& error) {
    message_ = error.what();
    failed_ = true;
  }
}

std::optional<glm::uvec2> Exporter::picture_size() const {
  const glm::uvec2 pixels = size == own ? own_size : sizes[size].pixels;
  if (with_panel || pixels == glm::uvec2(0)) return std::nullopt;
  return pixels;
}

void Exporter::write_curves() {
  attempt([&] {
    files::prepare_folder(absolute_folder(folder), "");
    const fs::path file = files::next_free_path(absolute_folder(folder), "curves", ".csv");
    files::write_file(file, curves_csv(simulation_, comparison_));
    return "Curves saved: " + hand_over(file);
  });
  show_message();
}

void Exporter::toggle_recording() {
  if (recording()) return stop();
  if (recording_) return;  // the last recording is still being written
  attempt([&] {
    recorded_ = &recording_kinds()[kind];
    std::unique_ptr<FrameWriter> writer = recorded_->make(absolute_folder(folder));
    progress_ = {.name = writer->name(), .error = {}};
    recording_ = std::make_unique<Background<RecordingTask>>(usual_runs, std::move(writer));
    recorded_frame_ = -1;
    bodies_.reset();
    return progress_.name;
  });
}

/// Ends the recording. Frames that wait are still written. `error`: why there are no more; empty if all went well.
void Exporter::stop(const std::string& error) {
  assert(recording());
  progress_.error = error;
  progress_.stopping = true;
  recording_->offer(std::nullopt);
}

void Exporter::frame(const Picture& picture) {
  if (std::exchange(picture_requested, false)) {
    attempt([&] {
      files::prepare_folder(absolute_folder(folder), "");
      const fs::path file = files::next_free_path(absolute_folder(folder), "picture", ".png");
      const engine::Image image = picture(with_panel, picture_size());
      files::write_file(file, engine::encode_png(image));
      return fmt::format("Picture saved: {} ({} x {})", hand_over(file), image.width, image.height);
    });
    show_message();
  }
  if (recording()) record(picture);
  follow_recording();
}

void Exporter::record(const Picture& picture) {
  const softbody::BodiesInMotion& world = simulation_.world();
  const int now = std::max(world.frame(), simulation_.world(Half::second).frame());  // a half that has stopped lags
  if (now == recorded_frame_ || !may_step()) return;
  // What is played begins again: all of its frames are written.
  if (simulation_.player() && now < recorded_frame_) return stop();
  recorded_frame_ = now;
  ExportedFrame frame;
  frame.number = now;
  if (recorded_->pictures) {
    try {
      frame.picture = picture(with_panel, picture_size());
    } catch (const std::runtime_error& refusal) {  // of the driver: the picture is too large
      return stop(refusal.what());
    }
  } else {
    if (!bodies_ || !bodies_->matches(world)) bodies_ = std::make_shared<const files::ObjWriter>(world);
    frame.bodies = bodies_;
    frame.positions.copy(world.positions());
  }
  recording_->offer(std::move(frame));
}

void Exporter::follow_recording() {
  if (!recording_) return;
  if (std::optional<RecordingProgress> now = recording_->take()) {
    now->stopping = progress_.stopping;
    if (now->error.empty()) now->error = progress_.error;
    progress_ = std::move(*now);
  }
  failed_ = !progress_.error.empty();
  message_ = failed_ ? progress_.error : progress_.name + ": " + std::to_string(progress_.written) + " frames";
  if (!failed_ && !progress_.ended && progress_.stopping) message_ += ", finishing";
  if (!progress_.ended) return;
  recording_.reset();
  show_message();
}

}  // namespace app::session
