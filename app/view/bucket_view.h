#pragma once
// The bucket inspector: what shares the selected bucket, and whether it shares a cell or but the bucket.

#include "app/demo/session.h"
#include "app/panel/widgets.h"

namespace app {

/// A window of this width (ImGui units) with its lower right corner there, while a bucket is selected; its cross
/// releases the bucket. Between begin_frame() and end_frame() of the Gui.
void draw_bucket(Widgets& widgets, Session& session, const ImVec2& lower_right, float width);

/// "body 3", "bodies 0, 3 and 7", "bodies 0, 3 and 12 more": of the entries of one cell.
std::string bodies_of(const CellGroup& group, const BucketContents& bucket, const collide::DebugGeometry& debug,
                      std::span<const softbody::BodyId> vertex_body);

/// "(0, -1, 2)"
std::string cell_text(const Cell& cell);

}  // namespace app
