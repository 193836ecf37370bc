#pragma once
// The bucket inspector: what shares the selected bucket, and whether it shares a cell or but the bucket.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app {

/// Draws the selected bucket, whose contents must be known, into the current window; its cross releases the bucket.
void draw_bucket(Widgets& widgets, Session& session);

/// "body 3", "bodies 0, 3 and 7", "bodies 0, 3 and 12 more": of the entries of one cell.
std::string bodies_of(const CellGroup& group, const BucketContents& bucket, const collide::DebugGeometry& debug,
                      std::span<const softbody::BodyId> vertex_body);

/// "(0, -1, 2)"
std::string cell_text(const Cell& cell);

}  // namespace app
