#include "app/session/compare_worker.h"

namespace app {

/// Too little memory for a comparison must not end the demo: its report says so instead.
CompareReport CompareTask::answer(const FrameSnapshot& snapshot, const std::stop_token& stop) {
  try {
    return comparison.run(snapshot, stop);
  } catch (const std::exception& error) {
    CompareReport report;
    report.id = snapshot.id;
    report.frame = snapshot.frame_number;
    report.reference_note = std::string("the comparison failed: ") + error.what();
    report.rows.resize(collide::method_table().size());
    return report;
  }
}

}  // namespace app
