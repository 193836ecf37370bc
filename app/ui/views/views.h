#pragma once
// The views that keep no state of their own. Each draws into the current window, unless it says otherwise.

#include "app/session/import.h"
#include "app/ui/views/status.h"

namespace app::ui {

/// Draws the bucket inspector: the entries of the selected bucket, grouped by the cells that they come from. Its
/// contents must be known. Its close button deselects it.
void draw_bucket(Widgets& widgets, Session& session);

/// The bodies of the entries of one cell: "body 3", "bodies 0, 3 and 7", "bodies 0, 3 and 12 more".
std::string bodies_text(const compare::CellGroup& group, const compare::BucketContents& bucket,
                        const collide::DebugGeometry& debug, const collide::Bodies& of_world);

/// "(0, -1, 2)"
std::string cell_text(const compare::Cell& cell);

/// "12 / 3": the pairs in the same cell, and the aliased ones.
std::string sharing_text(const compare::Sharing& sharing);

/// Returns the height in ImGui units that the comparison of so many methods needs in an area of this width.
float compare_height(std::size_t methods, float width, float scale);
/// Draws the comparison of methods on one frozen frame over `area`: a row for each shown method with its cost and its
/// true contacts. Sets `show_misses` when the user chooses the method whose misses the scene shows, and `open` to false
/// when the user closes the comparison. Call it between begin_frame() and end_frame() of the Gui.
void draw_compare(Widgets& widgets, Session& session, bool& show_misses, bool& open, const ScreenRect& area);

/// Draws the progress of a file that is being read, and the report on the last files until the user closes it: what was
/// found in each and what was done to it. It stands in the lower left corner of `area`, over the scene, so that it
/// moves nothing on the panel. Draws nothing if there is neither.
void draw_import_report(Widgets& widgets, Session& session, session::Import& import, const ScreenRect& area);

/// Draws the list of all methods in their groups as a combo with this label and preview. A click on a name lets the
/// method drive. A check box shows or hides a method, a group or all methods.
void draw_method_choice(Widgets& w, Session& session, const char* label, const char* preview, const char* tooltip);
/// The same, to choose what a view shows. The preview says how many methods are shown.
void draw_shown_methods(Widgets& w, Session& session);

/// Draws the surface oracle's figures of the last step that it judged. The rarely needed ones are in a section that is
/// folded at first.
void draw_true_surfaces(Widgets& widgets, const Session& session);

}  // namespace app::ui
