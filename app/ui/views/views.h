#pragma once
// The views that keep no state of their own. Each draws into the current window, unless it says otherwise.

#include "app/ui/views/status.h"

namespace app::ui {

/// Draws the bucket inspector: the entries of the selected bucket, grouped by the cells that they come from. Its
/// contents must be known. Its close button deselects it.
void draw_bucket(Widgets& widgets, const Session& session);

/// Draws what the two halves have cost and missed over `area`, and the line between them over the scene. There must be
/// a second world. Returns the height in ImGui units that the area should have.
float draw_beside(Widgets& widgets, const Session& session, const UiState& ui, const ScreenRect& area,
                  const ScreenRect& scene);

/// Returns the height in ImGui units that the comparison of so many methods needs in an area of this width.
float compare_height(std::size_t methods, float width, float scale);
/// Draws the comparison of methods on one frozen frame over `area`: a row for each shown method with its cost and its
/// true contacts. Call it between begin_frame() and end_frame() of the Gui.
void draw_compare(Widgets& widgets, const Session& session, const UiState& ui, const ScreenRect& area);

/// Draws the progress of a file that is being read, and the report on the last files until the user closes it: what was
/// found in each and what was done to it. Draws nothing if there is neither.
void draw_import_report(Widgets& widgets, const session::Import& import);
/// Draws what methods of the user's own ask or say, if anything.
void draw_guest_report(Widgets& widgets, const session::Guests& guests);

/// Draws the hash table of the method that is shown: a square for each bucket, coloured by its load. A click asks for
/// the bucket: its boxes are shown in the scene.
void draw_hash_table(Widgets& widgets, const Session& session);
/// Returns the number of entries in the fullest bucket.
std::uint32_t longest_bucket(const collide::DebugGeometry& table);

/// Draws the list of all methods in their groups as a combo with this label and preview. A click on a name lets the
/// method drive. A check box shows or hides a method, a group or all methods.
void draw_method_choice(Widgets& w, const Session& session, std::string_view label, std::string_view preview,
                        std::string_view tooltip);
/// The same, to choose what a view shows. The preview says how many methods are shown.
void draw_shown_methods(Widgets& w, const Session& session);

/// Draws what the paper's method and an exact one find. The comparison must include the paper's
/// (CompareChoice::with_paper).
void draw_story(Widgets& widgets, const Session& session);
/// Draws what misses cost in this scene, as far as it is known, and a sentence on what is missed, each behind a button
/// that shows it.
void draw_story_sentences(Widgets& widgets, const Session& session);

/// Draws the surface oracle's figures of the last step that it judged. The rarely needed ones are in a section that is
/// folded at first.
void draw_true_surfaces(Widgets& widgets, const Session& session);

/// Draws the tour's step over the whole of `area`. Call it between begin_frame() and end_frame() of the Gui.
void draw_tour(Widgets& widgets, const Session& session, const Tour& tour, const ScreenRect& area);

}  // namespace app::ui
