#pragma once
// What the user has opened and asked for in the window. The rest of the demo's state belongs to the Session.

#include <cstddef>
#include <map>
#include <string>

#include "app/render/overlays.h"
#include "app/session/session.h"
#include "app/ui/state/requests.h"
#include "app/ui/tour/tour.h"

namespace app::ui {

inline constexpr const char* no_solver_text = "the motion is recorded";

/// What stands below the scene.
enum class LowerView { none, comparison, sweep };

/// What the window shows at the next start, too.
struct Remembered {
  render::Overlays overlays;
  bool panel = true, lights = true, hash_table = true;
  bool story_at_start = true;  // whether the default scene opens with the card of `story`
  LowerView lower = LowerView::none;
  std::map<std::string, bool> sections;  // of the panel: whether they are open, by label

  bool operator==(const Remembered&) const = default;
};

struct UiState : Remembered {
  bool story = false;  // the card on what the paper's method misses
  bool clean = false;  // nothing but the scene
  bool help = false;
  bool coverage_explained = false;  // below the coverage light
  bool popup_open = false;          // a list to choose from, in the last frame

  bool beside_as_ghost = false;  // the second world is drawn over the first, not beside it
  float line = 0.5f;             // the share of the width where the line between two worlds lies

  float render_scale = 1;       // of the scene's picture, see Canvas
  double picture_interval = 0;  // s from picture to picture, on purpose; infinity: drawn when something changes
  softbody::View view;          // the camera, as a scene file describes it
  Tour tour;
  std::optional<WindowTask> once_compared;  // is left to the window when the present frame has been compared

  /// Returns the overlays that are drawn: all that are asked for, but without a solver none that needs one.
  render::Overlays drawn_overlays(const Session& session) const {
    render::Overlays drawn = overlays;
    for (const render::OverlayRow& row : render::overlay_table)
      if (row.needs_solver && !session.simulated()) drawn.*row.shown = false;
    return drawn;
  }
  /// True if the scene marks what the paper's method misses.
  bool marks_story() const { return story && !clean && !tour.open(); }
  /// True if the card is on the screen. The views below the scene say the same.
  bool shows_story() const { return marks_story() && lower == LowerView::none; }
  void toggle(LowerView part) { lower = lower == part ? LowerView::none : part; }
  /// The card takes the place of the views below the scene.
  void set_story(bool on) {
    story = story_at_start = on;
    if (on) lower = LowerView::none;
  }
  /// Opens a section of the panel that stands under *More*.
  void open_section(const char* name) { sections["More"] = sections[name] = true; }
  /// A hash table that is put away takes its bucket with it.
  void toggle_hash_table(Session& session) {
    hash_table = !hash_table;
    if (!hash_table) session.inspector.select_bucket(std::nullopt);
  }
  /// Brings the values of a solid into sight.
  void show_solid(std::size_t index) {
    solid = index;
    scrolls_to_solid = true;
    open_section("Solids");
  }
  std::string save_as = "scene.toml";  // the file that the scene is saved to ...
  session::FieldNotice save_problem;   // ... why it was not written ...
  session::FieldNotice save_question;  // ... and what the user must answer first
  std::size_t material = 0;            // whose values the panel shows
  std::optional<std::size_t> solid;    // the same; nullopt: those of the first in its list
  bool scrolls_to_solid = false;       // the panel, in the next frame
};

}  // namespace app::ui
