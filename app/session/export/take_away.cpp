#include "app/session/export/take_away.h"

#include <map>
#include <optional>
#include <utility>

#include "app/base/table.h"
#include "app/files/output_file.h"

namespace app {
namespace fs = std::filesystem;
namespace {

struct Curve {
  std::string name;
  const Ring& ring;
};

std::vector<Curve> curves_of(const Session& session) {
  const History& history = session.history();
  const StabilityHistory& motion = session.stability().history();
  std::vector<Curve> curves{{"frame_ms", history.frame_ms},
                            {"detect_ms", history.detect_ms},
                            {"solve_ms", history.solve_ms},
                            {"contacts", history.contacts},
                            {"recall", history.recall},
                            {"kinetic_J", motion.kinetic},
                            {"elastic_J", motion.elastic},
                            {"gas_J", motion.gas},
                            {"gravity_J", motion.gravity},
                            {"total_J", motion.total},
                            {"least_volume", motion.least_volume},
                            {"most_volume", motion.most_volume},
                            {"strain", motion.strain},
                            {"speed_m_s", motion.speed}};
  for (std::size_t i = 0; i < history.method_ms.size(); ++i)
    curves.push_back({std::string(collide::method_table()[i].key) + "_ms", history.method_ms[i]});
  return curves;
}

/// As the user names it, from any folder.
fs::path whole(const std::string& folder) { return fs::absolute(folder.empty() ? "." : folder).lexically_normal(); }

}  // namespace

std::string curves_csv(const Session& session) {
  const std::vector<Curve> curves = curves_of(session);
  // Of several values of a frame (it was paused, or gone back to) the last counts.
  std::map<int, std::vector<std::optional<float>>> rows;
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t i = 0; i < curves[c].ring.size(); ++i) {
      auto& row = rows[curves[c].ring.frame(i)];
      row.resize(curves.size());
      row[c] = curves[c].ring[i];
    }
  std::vector<std::string> columns{"frame"};
  for (const Curve& curve : curves) columns.emplace_back(curve.name);
  Table table(columns);
  for (const auto& [frame, values] : rows) {
    TableRow row{{"frame", frame}};
    for (std::size_t c = 0; c < curves.size(); ++c) row.push_back({columns[c + 1], values[c]});
    table.add(row);
  }
  return table.csv();
}

/// Whatever goes wrong is a message.
void TakeAway::attempt(const std::function<std::string()>& action) {
  try {
    message_ = action();
    failed_ = false;
  } catch (const std::exception& error) {
    message_ = error.what();
    failed_ = true;
  }
}

void TakeAway::write_curves(const Session& session) {
  attempt([&] {
    prepare_folder(whole(folder), "");
    const fs::path file = next_free(whole(folder), "curves", ".csv");
    write_file(file, curves_csv(session));
    return file.string();
  });
}

void TakeAway::write_picture(const Picture& picture) {
  attempt([&] {
    prepare_folder(whole(folder), "");
    const fs::path file = next_free(whole(folder), "picture", ".png");
    write_file(file, engine::encode_png(picture(with_panel)));
    return file.string();
  });
}

void TakeAway::toggle_recording() {
  if (recording()) return recording_->stop();
  if (recording_) return;  // the last one is still being written
  attempt([&] {
    recorded_ = &recording_kinds[kind];
    recording_ = std::make_unique<FrameRecording>(recorded_->make(whole(folder)));
    recorded_frame_ = -1;
    bodies_.reset();
    return recording_->progress().name;
  });
}

void TakeAway::frame(const Session& session, const Picture& picture) {
  if (std::exchange(picture_asked, false)) write_picture(picture);
  if (recording()) record(session, picture);
  follow_recording();
}

void TakeAway::record(const Session& session, const Picture& picture) {
  const softbody::World& world = session.world();
  if (world.frame() == recorded_frame_ || !recording_->has_room()) return;
  recorded_frame_ = world.frame();
  RecordedFrame frame;
  frame.number = world.frame();
  if (recorded_->pictures) {
    frame.picture = picture(with_panel);
  } else {
    if (!bodies_ || !bodies_->are_those_of(world)) bodies_ = std::make_shared<const MovingBodies>(world);
    frame.bodies = bodies_;
    frame.positions.copy(world.positions());
  }
  recording_->add(std::move(frame));
}

void TakeAway::follow_recording() {
  if (!recording_) return;
  const FrameRecording::Progress progress = recording_->progress();
  failed_ = !progress.error.empty();
  message_ = failed_ ? progress.error : progress.name + ": " + std::to_string(progress.written) + " frames";
  if (!failed_ && !progress.ended && progress.stopping) message_ += ", finishing";
  if (progress.ended) recording_.reset();
}

}  // namespace app
