#pragma once
// Colours, sizes and font of the panels.

namespace engine {

/// Sets ImGui's colours and its sizes, multiplied by `scale` > 0.
void apply_theme(float scale);

/// Fills ImGui's font atlas with a system font, or with ImGui's own if none is found. `pixels` > 0 is the height.
void load_font(float pixels);

}  // namespace engine
