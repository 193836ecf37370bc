// Requests of the interface and of keys, and what is carried out beside them.

#include "app/ui/state/requests.h"

#include <gtest/gtest.h>

#include "app/ui/state/ui_state.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

TEST(CarryOut, ActsInOrderAndLeavesTasksToTheWindow) {
  Session session(touching_pair(), {}, 1);
  ui::UiState state;
  const ui::Requests requests{[](Session& s, ui::UiState&) { s.bodies.select(1); }, ui::WindowTask::show_selected_body,
                              [](Session& s, ui::UiState& ui) { ui.material = *s.bodies.selected(); },
                              ui::WindowTask::quit};
  const std::vector<ui::WindowTask> tasks = carry_out(requests, session, state);
  EXPECT_EQ(state.material, 1u);
  EXPECT_TRUE(tasks == (std::vector{ui::WindowTask::show_selected_body, ui::WindowTask::quit}));
}

TEST(CarryOut, TellsTheSessionWhatTheWindowWants) {
  Session session(touching_pair(), {}, 1);
  ui::UiState state;
  carry_out({[](Session&, ui::UiState& ui) {
              ui.toggle(ui::LowerView::comparison);
              ui.overlays.missed = ui.overlays.true_surfaces = ui.story = true;
            }},
            session, state);
  const session::CompareChoice& choice = session.comparison.choice;
  EXPECT_TRUE(choice.on && choice.with_misses && choice.with_paper && session.surfaces.on);
  carry_out({[](Session&, ui::UiState& ui) {
              ui = {};
              ui.panel = false;
            }},
            session, state);
  EXPECT_FALSE(choice.on || choice.with_misses || choice.with_paper || session.surfaces.on);
}

TEST(CarryOut, LetsTheCameraFrameTheTourOnceForEachStep) {
  Session session(touching_pair(), {}, 1);
  ui::UiState state;
  const auto tasks = [&](const ui::Requests& requests) { return carry_out(requests, session, state); };
  EXPECT_TRUE(tasks({[](Session& s, ui::UiState& ui) { ui.tour.start(s, ui.overlays); }}) ==
              (std::vector{ui::WindowTask::show_as_before_tour, ui::WindowTask::show_highlight}));
  EXPECT_TRUE(tasks({}).empty());
  EXPECT_TRUE(tasks({[](Session&, ui::UiState& ui) { ui.tour.next(); }}) ==
              std::vector{ui::WindowTask::show_highlight});
}

}  // namespace THIS_FILE
}  // namespace app
