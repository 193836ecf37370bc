#pragma once
// The bucket inspector: the entries of the selected bucket, grouped by the cells that they come from.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Draws the selected bucket into the current window. Its contents must be known. Its close button deselects it.
void draw_bucket(Widgets& widgets, Session& session);

/// The bodies of the entries of one cell: "body 3", "bodies 0, 3 and 7", "bodies 0, 3 and 12 more".
std::string bodies_text(const compare::CellGroup& group, const compare::BucketContents& bucket,
                        const collide::DebugGeometry& debug, const collide::Bodies& of_world);

/// "(0, -1, 2)"
std::string cell_text(const compare::Cell& cell);

/// "12 / 3": the pairs in the same cell, and the aliased ones.
std::string sharing_text(const compare::Sharing& sharing);

}  // namespace app::ui
