#pragma once
// What it costs in a scene that a method misses contacts: the scene is run by the paper's method and by the exact one.

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "app/base/background.h"
#include "app/compare/difference.h"
#include "app/compare/run_figures.h"
#include "app/compare/world_oracle.h"
#include "softbody/world/world.h"

namespace app::compare {

/// The figures of three runs of a scene from its start.
struct Price {
  static constexpr int frames = 420;
  /// By the exact method, and by the paper's with automatic cells and with those of half this size.
  enum Run { exact, automatic_cells, small_cells };
  struct Figures {
    float cell = 0;  // m, the longest side
    RunTotals totals;
  };
  std::array<Figures, 3> runs{};  // by Run
  std::string failure;            // why there are no figures, else empty
};

/// Makes the runs, a frame a part, as a task for Background.
class PriceTrial {
 public:
  using Question = HowSimulated;
  using Answer = Price;
  static constexpr int rests = 1;  // so the runs take at most half a core

  std::optional<Price> advance(const HowSimulated& how, const Background<PriceTrial>& background);

 private:
  /// A run in progress.
  struct Trial {
    explicit Trial(const HowSimulated& how) : world(how.scene, {.integrator = how.integrator}) {}
    softbody::World world;
    RunFigures figures;
    WorldOracle oracle{1};
  };
  void begin(HowSimulated how);

  std::deque<Trial> trials_;  // by Price::Run, a frame each in turn, so that their times can be compared
};

}  // namespace app::compare
