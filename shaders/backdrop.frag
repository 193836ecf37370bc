#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
out vec4 fragment;

void main() { fragment = vec4(dithered(backdrop()), 1.0); }
