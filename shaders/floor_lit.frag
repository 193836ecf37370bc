#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "floor.glsl"

// Floor in full light.
void main() { fragment = vec4(dithered(bare_floor()), 1.0); }
