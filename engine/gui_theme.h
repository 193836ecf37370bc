#pragma once
// The look of the panels.

namespace engine {

/// Sets ImGui's colours, and its sizes times `scale`.
void apply_theme(float scale);

/// Fills ImGui's font atlas: a legible font of the system at `pixels` height, else ImGui's own.
void load_font(float pixels);

}  // namespace engine
