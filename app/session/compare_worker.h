#pragma once
// The comparison on a thread of its own.

#include "app/base/background_worker.h"
#include "app/compare/compare.h"

namespace app {

struct CompareTask {
  using Question = FrameSnapshot;
  using Answer = CompareReport;
  static constexpr std::uint32_t seed = 1;  // of the shuffled order: every run of the demo shuffles alike

  CompareReport answer(const FrameSnapshot& snapshot, const std::stop_token& stop);

  Comparison comparison{seed};
};
using CompareWorker = BackgroundWorker<CompareTask>;

}  // namespace app
